/// The least time of one straight way from rest to rest, in closed form.
#pragma once

#include <limits>

namespace flank::internal {

/// Of a way: units of it by seconds, their squares and cubes; all > 0, infinite where there is no limit.
struct WayLimits {
  double speed = std::numeric_limits<double>::infinity();
  double acceleration = std::numeric_limits<double>::infinity();
  double jerk = std::numeric_limits<double>::infinity();
};

/// Seconds of a way >= 0: up to three parts to speed up (jerk, largest acceleration, jerk), one at the largest speed, the same three to slow
/// down. At least two of the limits are finite.
[[nodiscard]] double seconds_from_rest_to_rest(double way, const WayLimits& limits);

}  // namespace flank::internal
