#include "flank/cover/line_guard.h"

#include <algorithm>
#include <cmath>

namespace flank {

Pose slid_clear(const LineGuard& guard, const Pose& pose, double reach_mm) {
  constexpr int kSteps = 5;
  constexpr double kLeastGain = 0.05;  ///< a slide that frees less than this per millimetre leads nowhere
  if (guard.clear(pose)) return pose;
  // A little more than needed: the refinement that follows moves the axis again.
  const double wanted = guard.floor_mm + 0.3 * std::abs(guard.floor_mm);
  Pose at = pose;
  double slide = 0.0;
  for (int k = 0; k < kSteps; ++k) {
    const PoseClearance found = guard.checker->measure(at, std::max(0.1, 4.0 * std::abs(guard.floor_mm)));
    if (found.surface < 0 || found.clearance_mm >= guard.floor_mm) return at;
    const double gain = found.tip_gradient.dot(pose.axis);
    if (std::abs(gain) < kLeastGain) return at;
    slide = std::clamp(slide + (wanted - found.clearance_mm) / gain, -reach_mm, reach_mm);
    at.tip = pose.tip + slide * pose.axis;
  }
  return at;
}

}  // namespace flank
