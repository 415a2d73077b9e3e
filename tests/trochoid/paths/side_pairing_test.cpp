// Places across from one another: right angles where there are some, and always forwards.
#include "flank/trochoid/paths/side_pairing.h"

#include <gtest/gtest.h>

#include <cmath>

namespace flank::internal {
namespace {

constexpr double kLength = 30.0, kMiddle = 15.0;

/// Along a curve of x at a distance y, the axis upright.
template <class F>
SidePath side(const F& at) {
  std::vector<Pose> poses;
  std::vector<double> t;
  for (int k = 0; k <= 80; ++k) {
    t.push_back(k / 80.0);
    poses.push_back({at(t.back()), Vec3::UnitZ()});
  }
  return {fit_motion(poses, t, kLength, 24), false};
}

double skew(const SidePath& a, double x, const SidePath& b, double y) {
  const AxisPlace p = a.at(x), q = b.at(y);
  const Vec3 across = q.at(kMiddle) - p.at(kMiddle);
  return std::asin(0.5 * across.normalized().dot(p.velocity(kMiddle) + q.velocity(kMiddle)));
}

TEST(SidePairing, JoinsAtRightAnglesWhereTheSidesAreEven) {
  // A quarter of a ring: the outer side is longer, and places across are at the same angle.
  const auto ring = [](double radius) {
    return [radius](double t) { return Vec3(radius * std::sin(1.5 * t), 60.0 - radius * std::cos(1.5 * t), 0.0); };
  };
  const SidePath inner = side(ring(40.0)), outer = side(ring(56.0));
  const SidePairing pairing(inner, outer, 12.0);
  for (const double share : {0.15, 0.4, 0.6, 0.85}) {
    const double x = share * inner.length();
    EXPECT_NEAR(pairing.at(x), share * outer.length(), 0.002 * outer.length()) << share;
    EXPECT_LT(std::abs(skew(inner, x, outer, pairing.at(x))), 0.01) << share;
  }
}

TEST(SidePairing, ASkewedStartIsPairedAcross) {
  const SidePath a = side([](double t) { return Vec3(50.0 * t, 0.0, 0.0); });
  const SidePath b = side([](double t) { return Vec3(20.0 + 50.0 * t, 15.0, 0.0); });
  const SidePairing pairing(a, b, 25.0);
  for (const double x : {-15.0, 0.0, 20.0, 45.0, 60.0, 200.0}) EXPECT_NEAR(pairing.at(x), x - 20.0, 1e-3) << x;
}

TEST(SidePairing, GoesForwardsAlsoWhereASideWinds) {
  const SidePath a = side([](double t) { return Vec3(50.0 * t, 8.0 * std::sin(9.0 * t), 0.0); });
  const SidePath b = side([](double t) { return Vec3(50.0 * t, 18.0 + 3.0 * std::cos(7.0 * t), 0.0); });
  const SidePairing pairing(a, b, 20.0);
  double before = pairing.at(-40.0);
  for (double x = -39.5; x < a.length() + 40.0; x += 0.5) {
    const double y = pairing.at(x);
    EXPECT_GE(y, before - 1e-9) << x;
    EXPECT_LT(y - before, 0.5 * 5.0) << x << ": no jump";
    before = y;
  }
}

}  // namespace
}  // namespace flank::internal
