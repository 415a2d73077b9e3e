// Targets moved towards the tool: closed forms on planes, cylinders and spheres, differences on a free form.
#include "flank/surface/offset_target.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "surface/mesh_shapes.h"
#include "surface/nurbs_fixtures.h"

namespace flank::internal {
namespace {

constexpr double kOffset = 0.4;

/// A sphere's band about the origin, of this radius: 180 degrees round z, between the heights -h and h for h = r / sqrt(2).
Face band(double radius) {
  const double c = std::numbers::sqrt2 / 2.0;
  return test::revolved(2, 2, {0, 0, 0, 1, 1, 1},
                        {{radius * c, -radius * c, 1.0}, {radius / c, 0.0, c}, {radius * c, radius * c, 1.0}});
}

Face wave() {
  Face face;
  face.id = "F1";
  std::vector<Vec3> points;
  std::vector<double> t;
  for (int k = 0; k <= 20; ++k) t.push_back(k / 20.0);
  for (const double u : t)
    for (const double v : t) points.emplace_back(40 * u, 30 * v, 3 * std::sin(3 * u) * std::cos(2 * v));
  face.surface = interpolate_grid(points, t, t, 3);
  return face;
}

/// On which side of the face +1 is, the tests ask the target itself.
int outside_of_band(double radius) {
  return make_target({band(radius)}, +1)->closest(Vec3(0.0, 2.0 * radius, 0.0)).distance > 0.0 ? +1 : -1;
}

TEST(OffsetTarget, OfASphereIsASphereOnBothSides) {
  constexpr double kRadius = 10.0;
  const int outside = outside_of_band(kRadius);
  for (const int away : {+1, -1}) {
    const auto target = offset_target(make_target({band(kRadius)}, away * outside), kOffset);
    const double moved = kRadius + away * kOffset;
    EXPECT_NEAR(target->area(), 2.0 * std::numbers::pi * moved * moved * std::numbers::sqrt2 / 2.0,
                0.002 * target->area());
    for (const double at : {6.0, 9.7, 10.3, 13.0})
      for (const double angle : {0.4, 1.2, 2.5}) {
        const Vec3 direction = Vec3(std::cos(angle), std::sin(angle), 0.3).normalized();
        const Vec3 p = at * direction;
        const Footpoint foot = target->closest(p);
        EXPECT_EQ(foot.location, Location::kInside);
        EXPECT_NEAR(foot.distance, away * (at - moved), 1e-8);
        EXPECT_NEAR((foot.point - moved * direction).norm(), 0.0, 1e-8);
        EXPECT_NEAR((foot.normal - away * direction).norm(), 0.0, 1e-8);
        EXPECT_NEAR(foot.k1, -away / moved, 1e-6);
        EXPECT_NEAR(foot.k2, -away / moved, 1e-6);
        const Footpoint warm = target->track(p + Vec3(0.1, 0.0, 0.1), foot);
        EXPECT_NEAR(warm.distance, target->closest(p + Vec3(0.1, 0.0, 0.1)).distance, 1e-8);
      }
    for (const SurfaceSample& sample : target->samples(1.0)) EXPECT_NEAR(sample.point.norm(), moved, 1e-9);
  }
}

TEST(OffsetTarget, ABendTowardsTheToolIsTold) {
  const int outside = outside_of_band(2.0);
  EXPECT_NEAR(sharpest_bend(*make_target({band(2.0)}, -outside)), 0.5, 1e-6);
  EXPECT_NEAR(sharpest_bend(*make_target({band(2.0)}, +outside)), -0.5, 1e-6);
}

TEST(OffsetTarget, ASurfaceFarBelowIsNoneWithinTheHorizon) {
  const auto target = offset_target(make_target({test::plane(20.0)}), kOffset);
  EXPECT_LT(target->closest_within(Vec3(10.0, 10.0, 5.0), 4.5).patch, 0);
  EXPECT_GE(target->closest_within(Vec3(10.0, 10.0, 5.0), 4.7).patch, 0);
  EXPECT_LT(target->closest_within(Vec3(10.0, 10.0, -5.0), 5.3).patch, 0);
  EXPECT_GE(target->closest_within(Vec3(10.0, 10.0, -5.0), 5.5).patch, 0);
  EXPECT_NEAR(target->closest(Vec3(10.0, 10.0, -5.0)).distance, -5.4, 1e-12);
  EXPECT_NEAR(target->box().low.z(), kOffset, 1e-12);
  EXPECT_NEAR(target->box().high.z(), kOffset, 1e-12);
  EXPECT_NEAR(target->box().high.x(), 20.0, 1e-9);
}

TEST(OffsetTarget, ItIsRoundAboutItsBorder) {
  const auto target = offset_target(make_target({test::plane(20.0)}), kOffset);
  const Footpoint foot = target->closest(Vec3(23.0, 10.0, 4.0)), below = target->closest(Vec3(23.0, 10.0, -4.0));
  EXPECT_EQ(foot.location, Location::kBorder);
  EXPECT_NEAR(foot.distance, 5.0 - kOffset, 1e-9);
  EXPECT_NEAR((foot.point - Vec3(20.0, 10.0, 0.0) - kOffset * Vec3(0.6, 0.0, 0.8)).norm(), 0.0, 1e-9);
  EXPECT_NEAR(below.distance, kOffset - 5.0, 1e-9);
  EXPECT_NEAR((Vec3(23.0, 10.0, -4.0) - below.point).norm(), 5.0 - kOffset, 1e-9);
  for (const Vec3& p : target->border_points(1.0)) EXPECT_NEAR(p.z(), kOffset, 1e-12);
}

TEST(OffsetTarget, AboutASharpEdgeItIsRound) {
  // A roof: both planes fall away from the edge x = 0, z = 0.
  const Face left = test::bilinear({-20, 0, -20}, {-20, 20, -20}, {0, 0, 0}, {0, 20, 0});
  Face right = test::bilinear({0, 0, 0}, {0, 20, 0}, {20, 0, -20}, {20, 20, -20});
  right.id = "F2";
  auto roof = make_target({left, right});
  const double side = roof->closest(Vec3(-5.0, 10.0, 5.0)).distance > 0.0 ? 1.0 : -1.0;
  if (side < 0.0) roof = make_target({left, right}, -1);
  const auto target = offset_target(std::move(roof), kOffset);
  for (const double angle : {-0.6, -0.2, 0.0, 0.3, 0.7}) {
    const Vec3 direction(std::sin(angle), 0.0, std::cos(angle));
    const Footpoint foot = target->closest(Vec3(0.0, 10.0, 0.0) + 3.0 * direction);
    EXPECT_NEAR(foot.distance, 3.0 - kOffset, 1e-9) << angle;
    EXPECT_NEAR((foot.point - Vec3(0.0, 10.0, 0.0) - kOffset * direction).norm(), 0.0, 1e-9) << angle;
    EXPECT_NEAR((foot.normal - direction).norm(), 0.0, 1e-9) << angle;
  }
}

TEST(OffsetTarget, OfAFreeFormGradientAndCurvatureAreThoseOfDistance) {
  const auto target = offset_target(make_target({wave()}), kOffset);
  Random random(5);
  constexpr double kStep = 1e-4;
  for (int k = 0; k < 40; ++k) {
    const Vec3 p(random.uniform(5, 35), random.uniform(5, 25), random.uniform(1.0, 4.0) + 3.0);
    const Footpoint foot = target->closest(p);
    if (foot.location != Location::kInside) continue;
    EXPECT_NEAR((p - foot.point).norm(), std::abs(foot.distance), 1e-8);
    for (int i = 0; i < 3; ++i) {
      const Vec3 step = kStep * Vec3::Unit(i);
      const double change = target->track(p + step, foot).distance - target->track(p - step, foot).distance;
      EXPECT_NEAR(change / (2.0 * kStep), foot.normal[i], 1e-6);
    }
    // The normal turns by -k along a principal direction of the surface.
    const Footpoint on = target->track(foot.point, foot);
    for (const auto& [k_of, direction] : {std::pair(on.k1, on.d1), std::pair(on.k2, on.d2)}) {
      const Vec3 turned = target->track(on.point + kStep * direction, on).normal -
                          target->track(on.point - kStep * direction, on).normal;
      EXPECT_NEAR(turned.dot(direction) / (2.0 * kStep), -k_of, 1e-4 * (1.0 + std::abs(k_of)));
    }
  }
}

TEST(OffsetTarget, OfAMeshIsItsSmoothSurfaceMoved) {
  const auto flat = [](double u, double v) { return Vec3(40 * u, 30 * v, 0.0); };
  const auto target = offset_target(make_target(shapes::grid(12, 12, flat)), kOffset);
  const Footpoint foot = target->closest(Vec3(20.0, 15.0, 3.0));
  EXPECT_NEAR(std::abs(foot.distance), std::abs(3.0 - foot.normal.z() * kOffset), 1e-9);
  for (const SurfaceSample& sample : target->samples(4.0)) {
    EXPECT_NEAR(sample.point.z(), sample.normal.z() * kOffset, 1e-9);
    const SurfaceSample given = target->as_given(sample);
    EXPECT_NEAR((given.point - sample.point).norm(), 0.0, 1e-9);
  }
}

}  // namespace
}  // namespace flank::internal
