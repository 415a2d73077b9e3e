#include "flank/wheel/point/axis_rod.h"

#include <algorithm>

namespace flank::internal {

double shank_radius(const Tool& tool) {
  double largest = 0.0;
  for (const Vec2& p : tool.shank) largest = std::max(largest, p.y());
  return largest > 0.0 ? largest : meridian_point(tool.radial, tool.radial.axis_length()).y();
}

double rod_radius(double shank_mm, double reach_mm, RodRoom room) {
  constexpr double kPlannedShare = 2e-3, kGuardedShare = -5e-4;  // of the reach
  return shank_mm + (room == RodRoom::kPlanned ? kPlannedShare : kGuardedShare) * reach_mm;
}

}  // namespace flank::internal
