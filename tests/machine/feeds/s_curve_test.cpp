// The time of one straight way against integrals of its own parts.
#include "flank/machine/feeds/s_curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace flank::internal {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();

TEST(SCurve, WithoutALimitOfJerkIsATrapezoidOrATriangle) {
  EXPECT_NEAR(seconds_from_rest_to_rest(100.0, {50.0, 500.0, kNone}), 2.0 + 0.1, 1e-12);
  EXPECT_NEAR(seconds_from_rest_to_rest(2.0, {50.0, 500.0, kNone}), 2.0 * std::sqrt(2.0 / 500.0), 1e-12);
  EXPECT_EQ(seconds_from_rest_to_rest(0.0, {50.0, 500.0, 5000.0}), 0.0);
}

TEST(SCurve, HasSevenPartsWhereTheWayIsLong) {
  // 0.1 s at 5,000 mm/s^3 to 500 mm/s^2; 50 mm/s need another 0 s at it.
  EXPECT_NEAR(seconds_from_rest_to_rest(100.0, {50.0, 500.0, 5000.0}), 2.0 + 0.1 + 0.1, 1e-12);
  EXPECT_NEAR(seconds_from_rest_to_rest(100.0, {50.0, 500.0, 50000.0}), 2.0 + 0.1 + 0.01, 1e-12);
  EXPECT_NEAR(seconds_from_rest_to_rest(100.0, {50.0, 1e9, 5000.0}), 2.0 + 2.0 * std::sqrt(50.0 / 5000.0), 1e-12);
}

TEST(SCurve, WhereTheWayIsShortNeitherSpeedNorAccelerationIsReached) {
  // A quarter t at jerk j, three times more: the way is 2 j t^3.
  const double t = 0.03, j = 4000.0;
  EXPECT_NEAR(seconds_from_rest_to_rest(2.0 * j * t * t * t, {1e3, 1e3, j}), 4.0 * t, 1e-12);
  // The acceleration, not the speed: t at jerk, s at the acceleration, t back; twice. The way is a (t + s) (2 t + s).
  const double s = 0.05, a = j * t;
  EXPECT_NEAR(seconds_from_rest_to_rest(a * (t + s) * (2.0 * t + s), {1e3, a, j}), 2.0 * (2.0 * t + s), 1e-12);
}

TEST(SCurve, GrowsWithoutAJumpWithTheWay) {
  double before = 0.0;
  for (int k = 1; k <= 4000; ++k) {
    const double here = seconds_from_rest_to_rest(0.005 * k, {50.0, 500.0, 20000.0});
    EXPECT_GT(here, before);
    if (k > 40) {
      EXPECT_LT(here - before, 0.005 / 5.0);
    }
    before = here;
  }
}

}  // namespace
}  // namespace flank::internal
