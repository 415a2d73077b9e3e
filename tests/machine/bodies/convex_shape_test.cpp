// Distances of convex shapes: closed forms, and between what random directions and random points say.
#include "flank/machine/bodies/convex_shape.h"

#include <gtest/gtest.h>

#include <cmath>

#include "flank/base/random.h"

namespace flank::internal {
namespace {

constexpr double kFar = 1e9;

Vec3 vector_in(Random& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

Eigen::Isometry3d placed(const Vec3& at, double angle = 0.0, const Vec3& axis = Vec3::UnitZ()) {
  Eigen::Isometry3d t = Eigen::Isometry3d::Identity();
  t.translate(at);
  t.rotate(Eigen::AngleAxisd(angle, axis));
  return t;
}

ConvexShape random_shape(Random& random) {
  const double kind = random.uniform();
  const Vec3 a = vector_in(random, 5.0), b = vector_in(random, 5.0), c = vector_in(random, 5.0);
  if (kind < 0.3) return ConvexShape::box(a.cwiseMin(b), a.cwiseMax(b));
  if (kind < 0.6) return ConvexShape::triangle(a, b, c);
  return ConvexShape::frustum(a, random.uniform(0.1, 4.0), b, random.uniform(0.1, 4.0));
}

TEST(ConvexShape, DistancesThatAreKnown) {
  const ConvexShape box = ConvexShape::box({-1, -1, -1}, {1, 1, 1});
  EXPECT_NEAR(gap(box, box, placed({5, 0, 0}), kFar), 3.0, kGapErrorMm);
  EXPECT_NEAR(gap(box, box, placed({5, 6, 0}), kFar), 5.0, kGapErrorMm);
  // An edge towards a face.
  EXPECT_NEAR(gap(box, box, placed({5, 0, 0}, M_PI / 4.0), kFar), 4.0 - std::sqrt(2.0), kGapErrorMm);
  const ConvexShape cylinder = ConvexShape::frustum({0, 0, 0}, 2.0, {0, 0, 10}, 2.0);
  EXPECT_NEAR(gap(box, cylinder, placed({7, 0, 0}), kFar), 4.0, kGapErrorMm);
  EXPECT_NEAR(gap(box, cylinder, placed({0, 0, 4}), kFar), 3.0, kGapErrorMm);
  EXPECT_NEAR(gap(cylinder, cylinder, placed({9, 0, 0}), kFar), 5.0, kGapErrorMm);
  const ConvexShape cone = ConvexShape::frustum({0, 0, 0}, 3.0, {0, 0, 4}, 0.0);
  EXPECT_NEAR(gap(box, cone, placed({0, 0, -8}), kFar), 3.0, kGapErrorMm);
  const ConvexShape triangle = ConvexShape::triangle({4, -9, -9}, {4, 9, -9}, {4, 0, 9});
  EXPECT_NEAR(gap(box, triangle, placed({0, 0, 0}), kFar), 3.0, kGapErrorMm);
  EXPECT_EQ(gap(box, box, placed({1.5, 0.3, 0.1}), kFar), 0.0);
  EXPECT_EQ(gap(box, cylinder, placed({0, 0, -5}), kFar), 0.0);
  EXPECT_GE(gap(box, box, placed({5, 0, 0}), 1.0), 1.0) << "beyond `enough` any bound will do";
}

// Along its axis rounding must not put a point beside the disc.
TEST(ConvexShape, AFrustumEndsAtItsDiscs) {
  Random random(22);
  for (int trial = 0; trial < 2000; ++trial) {
    const Vec3 from = vector_in(random, 50.0), to = vector_in(random, 50.0), axis = (to - from).normalized();
    const ConvexShape shape = ConvexShape::frustum(from, 30.0, to, 20.0);
    for (const double sign : {1.0, -1.0})
      EXPECT_NEAR(axis.dot(shape.support(sign * axis)), axis.dot(sign > 0.0 ? to : from), 1e-9) << trial;
  }
}

// No pair of points is nearer than what is told, and no plane parts the shapes by more.
TEST(ConvexShape, LiesBetweenPointsAndPlanes) {
  Random random(21);
  int apart = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const ConvexShape a = random_shape(random), b = random_shape(random);
    const Eigen::Isometry3d at =
        placed(vector_in(random, 12.0), random.uniform(0, 6), vector_in(random, 1.0).normalized());
    const double told = gap(a, b, at, kFar);
    apart += told > 0.0 ? 1 : 0;
    double plane = 0.0, points = 1e300;
    for (int k = 0; k < 3000; ++k) {
      const Vec3 d = vector_in(random, 1.0).normalized();
      const Vec3 pa = a.support(d), pb = at * b.support(-(at.linear().transpose() * d));
      plane = std::max(plane, d.dot(pb - pa));
      points = std::min(points, (pb - pa).norm());
    }
    EXPECT_GE(told, plane - kGapErrorMm) << trial;
    EXPECT_LE(told, points + 1e-9) << trial;
    const double turned = gap(b, a, at.inverse(), kFar);
    EXPECT_NEAR(told, turned, kGapErrorMm) << trial;
  }
  EXPECT_GT(apart, 100);
}

}  // namespace
}  // namespace flank::internal
