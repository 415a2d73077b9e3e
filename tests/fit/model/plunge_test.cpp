#include "flank/fit/model/plunge.h"

#include <gtest/gtest.h>

#include <cmath>

#include "flank/base/random.h"

namespace flank::internal {
namespace {

const Vec3 kAxis = Vec3::UnitZ();

TEST(Plunge, ACylinderMayMoveAsItLikes) {
  EXPECT_EQ(plunge({0.0, 0.0, 5.0}, kAxis, 0.0).excess, 0.0);
  EXPECT_EQ(plunge({1.0, 2.0, 5.0}, kAxis, 0.0).excess, 0.0);
}

TEST(Plunge, AConeMayMoveAlongItsAxisAsFarAsItsEnvelopeIsThere) {
  const double slope = 0.3, factor = slope / std::sqrt(1.0 - slope * slope);
  // |c| = factor |v_u| / |v_across|.
  EXPECT_EQ(plunge({1.0, 0.0, 0.99 * kMostPlunge / factor}, kAxis, slope).excess, 0.0);
  EXPECT_NEAR(plunge({1.0, 0.0, -1.2 / factor}, kAxis, slope).excess, 1.2 - kMostPlunge, 1e-12);
  EXPECT_NEAR(plunge({0.0, 0.0, 2.0}, kAxis, -slope).excess, 2.0 * factor, 1e-12);
}

TEST(Plunge, GradientIsThatOfDifferences) {
  Random random(3);
  int plunging = 0;
  for (int trial = 0; trial < 200; ++trial) {
    Vec3 v, axis;
    for (int k = 0; k < 3; ++k) v[k] = random.uniform(-1.0, 1.0), axis[k] = random.uniform(-1.0, 1.0);
    axis.normalize();
    const double slope = random.uniform(-0.9, 0.9);
    const Plunge at = plunge(v, axis, slope);
    if (at.excess < 1e-3) continue;
    ++plunging;
    for (int k = 0; k < 3; ++k) {
      constexpr double kStep = 1e-6;
      const Vec3 by = kStep * Vec3::Unit(k);
      const double slope_k = (plunge(v + by, axis, slope).excess - plunge(v - by, axis, slope).excess) / (2.0 * kStep);
      EXPECT_NEAR(at.gradient[k], slope_k, 1e-5) << trial;
    }
  }
  EXPECT_GT(plunging, 20);
}

}  // namespace
}  // namespace flank::internal
