/// Which faces are one blade, and which are the hub that they stand on.
#pragma once

#include <vector>

#include "flank/feature/wheel_axis.h"

namespace flank::internal {

/// Faces that hang together, less those of revolution that stand at an angle or smoothly to them (hub, shroud).
struct BladeFaces {
  std::vector<const WheelFace*> faces;
  double area = 0.0;
};

/// Bores and other hollows of a blade are none of its faces.
void leave_out_hollows(BladeFaces& blade, double near_mm);

/// Of all faces; what could be a blade has sides that look both ways round the axis. Largest first.
[[nodiscard]] std::vector<BladeFaces> blade_candidates(const std::vector<WheelFace>& faces, const WheelAxis& axis,
                                                       double size_mm);

/// The faces of revolution that the blades stand on: the blades are on their outer side, and touch or enter them. And those
/// above the tips (`shroud`).
struct TurnedRoles {
  std::vector<const WheelFace*> hub, shroud;
};
[[nodiscard]] TurnedRoles turned_roles(const std::vector<WheelFace>& faces, const std::vector<BladeFaces>& blades,
                                       const WheelAxis& axis, double size_mm);

/// How near borders are that touch, mm: what triangles and gaps of loose faces allow.
[[nodiscard]] inline double touch_mm(double size_mm) { return 5e-4 * size_mm + 0.005; }

}  // namespace flank::internal
