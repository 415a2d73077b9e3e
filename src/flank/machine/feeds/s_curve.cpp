#include "flank/machine/feeds/s_curve.h"

#include <cmath>

namespace flank::internal {

double seconds_from_rest_to_rest(double way, const WayLimits& limits) {
  const auto [v, a, j] = limits;
  // Up to the largest speed: at the largest acceleration in the middle, where there is time to reach it.
  const bool reaches_acceleration = !(v * j < a * a);
  const double ramp = reaches_acceleration ? (std::isfinite(j) ? a / j : 0.0) + v / a : 2.0 * std::sqrt(v / j);
  if (way >= v * ramp) return way / v + ramp;
  // No stretch at the largest speed. First without one at the largest acceleration either: a peak of it is jerk times a quarter.
  const double quarter = std::isfinite(j) ? std::cbrt(way / (2.0 * j)) : 0.0;
  if (std::isfinite(j) && j * quarter <= a) return 4.0 * quarter;
  const double half = std::isfinite(j) ? 0.5 * a / j : 0.0;
  return 2.0 * (half + std::sqrt(half * half + way / a));
}

}  // namespace flank::internal
