#include "flank/path/joined_pose.h"

#include <limits>

namespace flank::internal {

Pose joined_pose(const Pose& from, const Pose& to, double t) {
  return {from.tip + t * (to.tip - from.tip), (from.axis + t * (to.axis - from.axis)).normalized()};
}

double joined_bend(const Pose& from, const Pose& to) {
  // u = w / |w| with w linear, |w'| = c and |w| >= x: the angle's speed is at most c / x, its acceleration 0.65 (c / x)^2.
  const double c = (to.axis - from.axis).norm(), x = 0.5 * (to.axis + from.axis).norm();
  return x > 0.0 ? 1.2 * (c / x) * (c / x) : std::numeric_limits<double>::infinity();
}

}  // namespace flank::internal
