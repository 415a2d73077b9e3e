/// One sector of a wheel: what is computed once and turned.
#pragma once

#include <string>
#include <vector>

#include "flank/feature/wheel_face.h"
#include "flank/feature/wheel_roles.h"
#include "flank/path.h"

namespace flank::internal {

/// A channel between two blades, by the sides that face each other. `turned`: the second side is that of the sector's own main
/// blade, a pitch on.
struct SectorChannel {
  std::vector<std::string> first, second;  ///< faces in the part
  std::vector<std::string> second_path;    ///< faces whose path, turned or not, is that of the second side
  bool turned = false;
};

struct WheelSector {
  std::vector<WheelBlade> blades;  ///< a main blade, and what stands up to the place a pitch on
  std::vector<SectorChannel> channels;
  double pitch_rad = 0.0;
  int copies = 1;  ///< in a whole turn, whether the part has them or not
  [[nodiscard]] std::vector<std::string> sides() const;
};

/// The sectors that the hub goes round, its rim counted; `roles.count` where it closes.
[[nodiscard]] double sectors_of_hub(const WheelRoles& roles, const std::vector<WheelFace>& faces);

/// Mean of the hub's normals along the axis, -1 to 1: of faces of solids, as nobody knows the side of others; 0: nothing is known.
[[nodiscard]] double hub_looks_along(const WheelRoles& roles, const std::vector<WheelFace>& faces);

/// Whether a wheel is machined from the end that its axis points to. A floor that leans (hub_looks_along()) is machined from where it looks to,
/// and so are the edges over it. Passes of the sides tell where it does not: those of a radial wheel lie across its axis, and a few degrees
/// would turn the wheel over.
[[nodiscard]] bool is_machined_from_ahead(double hub_looks, const std::vector<Strip>& strips, const WheelAxis& axis);

/// The first main blade with another one a pitch on, or itself where the wheel is one sector, and what stands between them. Throws InputError where no two main blades
/// are there.
[[nodiscard]] WheelSector make_sector(const WheelRoles& roles);
/// The sectors of all main blades that have another one a pitch on and are in no sector before, the one of make_sector() first.
[[nodiscard]] std::vector<WheelSector> all_sectors(const WheelRoles& roles);

/// "F1,F2".
[[nodiscard]] std::string face_list(const std::vector<std::string>& faces);
/// The strips that name one of the faces.
[[nodiscard]] std::vector<Strip> strips_of(const Path& path, const std::vector<std::string>& faces);
/// Poses turned about the wheel's axis.
[[nodiscard]] std::vector<Pose> turned(const std::vector<Pose>& poses, const WheelAxis& axis, double radians);
/// A blade that the wheel has and the part has not: a blade of the sector, turned by some pitches.
struct MissingBlade {
  WheelBlade blade;
  int turns = 0;
};
/// All of them, turned by 1 to the number of sectors less 1.
[[nodiscard]] std::vector<MissingBlade> missing_blades(const WheelRoles& roles, const WheelSector& sector);
/// Those beside a sector, a pitch before (-1) and behind: the blades of a part that is a piece of the wheel have neighbours, too.
[[nodiscard]] std::vector<MissingBlade> missing_beside(const WheelRoles& roles, const WheelSector& sector);

/// Whether a place is no more than half of a pitch about the axis from an angle: copies of those places are all that there are.
[[nodiscard]] bool is_within_pitch(const Vec3& p, const WheelAxis& axis, double middle_rad, double pitch_rad);

/// Every strip as often as there are sectors, one after the other, numbered anew.
[[nodiscard]] Path copied(const Path& sector, const WheelAxis& axis, double pitch_rad, int copies);

}  // namespace flank::internal
