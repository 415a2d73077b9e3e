/// One sector of a wheel: what is computed once and turned.
#pragma once

#include <string>
#include <vector>

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
  std::vector<WheelBlade> blades;  ///< a main blade, and the splitters up to the next one
  std::vector<SectorChannel> channels;
  double pitch_rad = 0.0;
  int copies = 1;  ///< that the part has
  [[nodiscard]] std::vector<std::string> sides() const;
};

/// The first main blade with another one behind it, and what stands between them. Throws InputError where no two main blades
/// are there.
[[nodiscard]] WheelSector make_sector(const WheelRoles& roles);
/// The sectors of all main blades that have another one behind them, the one of make_sector() first.
[[nodiscard]] std::vector<WheelSector> all_sectors(const WheelRoles& roles);

/// "F1,F2".
[[nodiscard]] std::string face_list(const std::vector<std::string>& faces);
/// The strips that name one of the faces.
[[nodiscard]] std::vector<Strip> strips_of(const Path& path, const std::vector<std::string>& faces);
/// Poses turned about the wheel's axis.
[[nodiscard]] std::vector<Pose> turned(const std::vector<Pose>& poses, const WheelAxis& axis, double radians);
/// Every strip as often as there are sectors in the part, a sector after the other, numbered anew.
[[nodiscard]] Path copied(const Path& sector, const WheelAxis& axis, double pitch_rad, int copies, bool whole);

}  // namespace flank::internal
