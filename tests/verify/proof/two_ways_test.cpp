// Two balls together against dense samples of the hull: a yes holds for each of them.
#include "flank/verify/proof/two_ways.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "verify/brute_force.h"

namespace flank::internal::verify {
namespace {

constexpr double kTolerance = 0.05;

SweptVolume::BallWay way(Random& random, const Vec3& center) {
  const Vec3 along = brute::random_vector(random, 0.6);
  return {center - random.uniform(0.0, 1.0) * along, along, 2.0, random.uniform(0.0, 0.004)};
}

/// A square of this half width on the plane z = 0, and a point a little above its middle.
std::vector<Vec3> square(Random& random, double half) {
  const Vec3 middle(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), 0.0);
  std::vector<Vec3> out;
  for (const double x : {-half, half})
    for (const double y : {-half, half}) out.emplace_back(middle + Vec3(x, y, 0.0));
  out.emplace_back(middle + Vec3(0.0, 0.0, 0.05 * half));
  return out;
}

Vec3 mix(Random& random, const std::vector<Vec3>& points) {
  Vec3 sum = Vec3::Zero();
  double weights = 0.0;
  for (const Vec3& p : points) {
    const double w = -std::log(random.uniform(1e-12, 1.0));
    sum += w * p, weights += w;
  }
  return sum / weights;
}

TEST(TwoWays, AYesHoldsForEachPlaceOfTheHull) {
  Random random(17);
  int yes = 0, more = 0;
  std::vector<double> sides;
  for (int trial = 0; trial < 4000; ++trial) {
    const double apart = random.uniform(0.1, 0.5);
    const Near a(way(random, {-apart, 0.0, 2.0}), kTolerance), b(way(random, {apart, 0.0, 2.0}), kTolerance);
    const std::vector<Vec3> points = square(random, random.uniform(0.02, 0.6));
    sides.resize(points.size());
    const auto all = [&](const Near& near) {
      return std::all_of(points.begin(), points.end(), [&](const Vec3& p) { return near.holds(p); });
    };
    if (!hold_together(points, a, b, points.back(), sides)) continue;
    ++yes, more += all(a) || all(b) ? 0 : 1;
    for (int k = 0; k < 60; ++k) {
      const Vec3 p = mix(random, points);
      ASSERT_TRUE(a.beyond(p) <= 1e-12 || b.beyond(p) <= 1e-12) << trial;
    }
  }
  EXPECT_GT(more, 400) << "together they are near more than each of them alone";
  EXPECT_LT(yes, 3500);
}

}  // namespace
}  // namespace flank::internal::verify
