// The least distance of a triangle to a posed body: degenerate triangles, cutoffs, symmetries, and the depth.
#include "flank/obstacle/triangle_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "flank/base/random.h"

namespace flank::internal {
namespace {

using Corners = std::array<Vec3, 3>;

Vec3 random_point(Random& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

/// A body, where it is, and a triangle near it.
struct Scene {
  ConvexProfile body{{{0, 4}, {30, 4}}};
  Pose pose;
  Corners corners;
};

std::vector<Scene> random_scenes(int count, double size, std::uint64_t seed) {
  Random random(seed);
  const std::vector<ConvexProfile> bodies = {ConvexProfile({{0, 4}, {30, 4}}), ConvexProfile({{0, 0}, {30, 9}}, 0.5),
                                             ConvexProfile({{0, 3}, {5, 6}, {20, 8}, {30, 8}, {34, 2}}),
                                             ConvexProfile({{7, 0}}, 5.0)};
  std::vector<Scene> scenes;
  for (int k = 0; k < count; ++k) {
    Scene scene{bodies[static_cast<std::size_t>(k) % bodies.size()],
                {random_point(random, 10.0), random_point(random, 1.0).normalized()},
                {}};
    const Vec3 middle = scene.pose.at(random.uniform(-10.0, 40.0)) + random_point(random, 20.0);
    for (Vec3& corner : scene.corners) corner = middle + random_point(random, size);
    scenes.push_back(scene);
  }
  return scenes;
}

TriangleDistance distance(const Scene& scene, double cutoff = 1e300, bool any = false) {
  return triangle_distance(scene.body, scene.pose, scene.corners, cutoff, any);
}

/// The least value at the points of a grid on the triangle: never below the truth.
double least_of_grid(const Scene& scene, int steps) {
  double least = 1e300;
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; i + j <= steps; ++j) {
      const double p = static_cast<double>(i) / steps, q = static_cast<double>(j) / steps;
      const Corners& v = scene.corners;
      least = std::min(least, body_jet(scene.body, scene.pose, v[0] + p * (v[1] - v[0]) + q * (v[2] - v[0])).value);
    }
  return least;
}

double error_of(double value) { return kTriangleDistanceError + std::max(0.0, -kDepthShareError * value); }

TEST(TriangleDistance, NoPointOfTheTriangleIsNearer) {
  for (const double size : {2.0, 15.0, 80.0}) {
    for (const Scene& scene : random_scenes(150, size, 41)) {
      const TriangleDistance found = distance(scene);
      ASSERT_TRUE(found.below);
      constexpr int kSteps = 60;
      const double grid = least_of_grid(scene, kSteps);
      ASSERT_LE(found.value, grid + error_of(grid));
      // A grid point lies within a cell of the nearest one, and distances change by no more than the way.
      ASSERT_GE(found.value, grid - 2.0 * std::sqrt(3.0) * size * 2.0 / kSteps);
    }
  }
}

TEST(TriangleDistance, TheValueIsThatOfItsPoint) {
  for (const Scene& scene : random_scenes(200, 15.0, 42)) {
    const TriangleDistance found = distance(scene);
    const BodyJet jet = body_jet(scene.body, scene.pose, found.point);
    EXPECT_EQ(found.value, jet.value);
    EXPECT_EQ(found.jet.value, jet.value);
    EXPECT_EQ(found.jet.gradient, jet.gradient);
  }
}

TEST(TriangleDistance, AValueThatIsNotBelowTheCutoffIsALowerBound) {
  int below = 0, above = 0;
  for (const Scene& scene : random_scenes(300, 15.0, 43)) {
    const double truth = distance(scene).value;
    for (const double off : {-3.0, -0.01, 0.01, 3.0}) {
      const TriangleDistance found = distance(scene, truth + off);
      ASSERT_EQ(found.below, off > 0.0) << truth << " " << off;
      if (found.below) {
        ASSERT_NEAR(found.value, truth, 2.0 * error_of(truth));
      } else {
        ASSERT_LE(found.value, truth + error_of(truth));
        ASSERT_GE(found.value, truth + off);
      }
      ++(found.below ? below : above);
    }
  }
  EXPECT_EQ(below, above);
}

TEST(TriangleDistance, AnyPlaceBelowTheCutoffWillDo) {
  for (const Scene& scene : random_scenes(300, 15.0, 44)) {
    const double truth = distance(scene).value;
    const TriangleDistance found = distance(scene, truth + 2.0, true);
    ASSERT_TRUE(found.below);
    ASSERT_LT(found.value, truth + 2.0);
    ASSERT_GE(found.value, truth - error_of(truth));
    ASSERT_FALSE(distance(scene, truth - 0.5, true).below);
  }
}

TEST(TriangleDistance, APointIsATriangleToo) {
  for (Scene scene : random_scenes(100, 1.0, 45)) {
    scene.corners[1] = scene.corners[2] = scene.corners[0];
    EXPECT_NEAR(distance(scene).value, body_jet(scene.body, scene.pose, scene.corners[0]).value, 1e-12);
  }
}

TEST(TriangleDistance, ASegmentIsATriangleToo) {
  for (Scene scene : random_scenes(100, 15.0, 46)) {
    scene.corners[2] = scene.corners[0] + 0.3 * (scene.corners[1] - scene.corners[0]);
    double least = 1e300;
    for (int k = 0; k <= 4000; ++k) {
      const Vec3 x = scene.corners[0] + k / 4000.0 * (scene.corners[1] - scene.corners[0]);
      least = std::min(least, body_jet(scene.body, scene.pose, x).value);
    }
    EXPECT_LE(distance(scene).value, least + error_of(least));
    EXPECT_GE(distance(scene).value, least - 0.02);
  }
}

TEST(TriangleDistance, ClosedFormsBesideACylinder) {
  const ConvexProfile body({{0, 4}, {30, 4}});
  const Pose pose{Vec3::Zero(), Vec3::UnitZ()};
  // A face beside it, an edge across it, a corner towards it, a plane above its end.
  EXPECT_NEAR(triangle_distance(body, pose, {Vec3(9, -50, 10), Vec3(9, 50, 10), Vec3(9, 0, 20)}, 1e300).value, 5.0,
              1e-8);
  EXPECT_NEAR(triangle_distance(body, pose, {Vec3(7, -9, 15), Vec3(7, 9, 15), Vec3(40, 0, 15)}, 1e300).value, 3.0,
              1e-8);
  EXPECT_NEAR(triangle_distance(body, pose, {Vec3(6, 0, 15), Vec3(20, -5, 3), Vec3(20, 5, 3)}, 1e300).value, 2.0, 1e-8);
  const TriangleDistance above =
      triangle_distance(body, pose, {Vec3(-90, -90, 37), Vec3(90, -90, 37), Vec3(0, 90, 37)}, 1e300);
  EXPECT_NEAR(above.value, 7.0, 1e-8);
  EXPECT_NEAR((above.jet.gradient - Vec3::UnitZ()).norm(), 0.0, 1e-6);
}

TEST(TriangleDistance, DepthsInsideAreExactToTheirShare) {
  const ConvexProfile body({{0, 4}, {30, 4}});
  const Pose pose{Vec3::Zero(), Vec3::UnitZ()};
  // The plane x = 2.5 through it: deepest along a whole line, where the mantle is 1.5 mm away.
  EXPECT_NEAR(triangle_distance(body, pose, {Vec3(2.5, -80, -40), Vec3(2.5, 80, -40), Vec3(2.5, 0, 110)}, 1e300).value,
              -1.5, 1.5 * kDepthShareError + 1e-8);
  // A plane across it: deepest on the axis, where the signed distance has a kink.
  EXPECT_NEAR(triangle_distance(body, pose, {Vec3(-80, -80, 15), Vec3(80, -80, 15), Vec3(0, 80, 15)}, 1e300).value,
              -4.0, 4.0 * kDepthShareError + 1e-8);
}

TEST(TriangleDistance, RigidMotionsChangeNothing) {
  Random random(47);
  for (const Scene& scene : random_scenes(100, 15.0, 48)) {
    const Vec3 axis = random_point(random, 1.0).normalized(), shift = random_point(random, 100.0);
    const Eigen::AngleAxisd turn(random.uniform(-3.0, 3.0), axis);
    Scene moved = scene;
    moved.pose = {turn * scene.pose.tip + shift, turn * scene.pose.axis};
    for (Vec3& corner : moved.corners) corner = turn * corner + shift;
    const double before = distance(scene).value;
    EXPECT_NEAR(distance(moved).value, before, 2.0 * error_of(before));
  }
}

TEST(TriangleDistance, TheOrderOfTheCornersChangesNothing) {
  for (Scene scene : random_scenes(100, 15.0, 49)) {
    const double before = distance(scene).value;
    for (int k = 0; k < 5; ++k) {
      std::swap(scene.corners[static_cast<std::size_t>(k % 2)], scene.corners[static_cast<std::size_t>(k % 2) + 1]);
      EXPECT_NEAR(distance(scene).value, before, 2.0 * error_of(before));
    }
  }
}

}  // namespace
}  // namespace flank::internal
