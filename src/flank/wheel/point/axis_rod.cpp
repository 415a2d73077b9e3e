#include "flank/wheel/point/axis_rod.h"

#include "flank/tool.h"

namespace flank::internal {

double rod_radius(const RadialFunction& radial, double reach_mm, RodRoom room) {
  constexpr double kPlannedShare = 6e-3, kGuardedShare = 5e-3;  // of the reach
  return kRodShare * radial.at(radial.axis_length()).r +
         (room == RodRoom::kPlanned ? kPlannedShare : kGuardedShare) * reach_mm;
}

}  // namespace flank::internal
