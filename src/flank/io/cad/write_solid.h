/// Solids built from faces: one blade, and blades on a piece of their hub.
#pragma once

#include <string>
#include <vector>

#include "flank/face.h"
#include "flank/vec.h"

namespace flank::internal {

/// One valid solid, as values and as the text of its file.
struct SolidModel {
  std::vector<Face> faces;  ///< in the order of the file, as read_part gives them
  std::string step;         ///< AP214, millimetres; the same input gives the same bytes
};

/// The solid that these faces bound, in their order. Neighbours share their borders to kSewingMm. Throws InternalError
/// if the faces leave a gap or make no valid solid.
[[nodiscard]] SolidModel sew_solid(const std::string& name, const std::vector<Face>& faces);
inline constexpr double kSewingMm = 1e-6;

/// A piece of a hub about the X axis: what lies between its outline and its bore, from one angle to another.
struct HubSector {
  std::vector<Vec2> profile;  ///< (x, radius), mm, x rising: the skin goes through these points
  double bore_radius_mm = 0.0;
  double from_rad = 0.0, to_rad = 0.0;  ///< about X, from +Y towards +Z
  [[nodiscard]] double turn_rad() const { return to_rad - from_rad; }
  [[nodiscard]] bool is_whole() const { return turn_rad() > 2.0 * 3.14159265358979323846 - 1e-9; }
};

/// The hub and all blades as one solid. Each blade is a closed skin of six faces: F1 to F4 stand round about, F5 lies
/// inside the hub, F6 is the tip. The faces of the solid, in order: the skin of the hub, its front, its cuts at
/// from_rad and to_rad (none where it goes all round), its back; F2, F3, F4, F1 of each blade; the bore; the tips. Throws InternalError if the result
/// has other faces, for example if a blade does not reach the hub.
[[nodiscard]] SolidModel fuse_blisk(const std::string& name, const HubSector& hub,
                                    const std::vector<std::vector<Face>>& blades);

}  // namespace flank::internal
