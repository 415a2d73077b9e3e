// Poses against closed solids and faces: depth, slide, and the tool that lies wholly inside.
#include "flank/obstacle/pose_guard.h"

#include <gtest/gtest.h>

#include "cover/cover_targets.h"

namespace flank::internal {
namespace {

/// A ball of radius 20 about the origin, as a closed mesh target.
std::shared_ptr<const Target> ball() {
  TriangleMesh mesh;
  constexpr int kRings = 32, kSectors = 64;
  const auto at = [](int i, int j) {
    const double a = 3.14159265358979 * i / kRings, b = 2.0 * 3.14159265358979 * j / kSectors;
    return Vec3(20.0 * std::sin(a) * std::cos(b), 20.0 * std::sin(a) * std::sin(b), 20.0 * std::cos(a));
  };
  mesh.vertices.push_back(at(0, 0));
  for (int i = 1; i < kRings; ++i)
    for (int j = 0; j < kSectors; ++j) mesh.vertices.push_back(at(i, j));
  mesh.vertices.push_back(at(kRings, 0));
  const auto index = [](int i, int j) { return 1 + (i - 1) * kSectors + j % kSectors; };
  const int last = static_cast<int>(mesh.vertices.size()) - 1;
  for (int j = 0; j < kSectors; ++j) {
    mesh.triangles.push_back({0, index(1, j), index(1, j + 1)});
    mesh.triangles.push_back({last, index(kRings - 1, j + 1), index(kRings - 1, j)});
    for (int i = 1; i + 1 < kRings; ++i) {
      mesh.triangles.push_back({index(i, j), index(i + 1, j), index(i, j + 1)});
      mesh.triangles.push_back({index(i + 1, j), index(i + 1, j + 1), index(i, j + 1)});
    }
  }
  return make_target(std::move(mesh));
}

TEST(PoseGuard, WithoutObstaclesEverythingIsClear) {
  const PoseGuard guard;
  EXPECT_TRUE(guard.clear(Pose{}));
  EXPECT_TRUE(guard.ball_is_clear(Vec3::Zero()));
}

TEST(PoseGuard, SeesDepthInAClosedSolid) {
  Obstacles obstacles;
  obstacles.solids.push_back(ball());
  const Tool tool = testing::cylinder(2.0, 10.0);
  const PoseGuard guard(tool, obstacles, -0.01);
  const Vec3 x = Vec3::UnitX();
  EXPECT_TRUE(guard.clear({22.1 * x, x}));
  EXPECT_FALSE(guard.clear({21.9 * x, x}));
  EXPECT_FALSE(guard.clear({-3.0 * x, x})) << "a tool wholly inside touches no face, and is not clear";
  const SlideClearance found = guard.measure({21.5 * x, x}, 1.0);
  EXPECT_NEAR(found.clearance_mm, -0.5, 0.02);
  EXPECT_NEAR(found.slide_gain, 1.0, 1e-3);
  EXPECT_TRUE(guard.ball_is_clear(22.1 * x));
  EXPECT_FALSE(guard.ball_is_clear(21.9 * x));
}

TEST(PoseGuard, FindsTheDeepestPlaceOfTheAxis) {
  Obstacles obstacles;
  obstacles.solids.push_back(ball());
  const PoseGuard guard(testing::cylinder(2.0, 60.0), obstacles, -0.01);
  // Grazing the ball and deep in it: the middle of the axis is deepest, not an end.
  for (const double height : {21.0, 15.0, 10.0}) {
    const SlideClearance found = guard.measure({Vec3(-33.0, height, 0.0), Vec3::UnitX()}, 5.0);
    EXPECT_NEAR(found.clearance_mm, height - 22.0, 0.1) << height;
    EXPECT_NEAR(found.slide_gain, 0.0, 0.1) << height;
  }
}

TEST(PoseGuard, SlidesOutAlongTheAxis) {
  Obstacles obstacles;
  obstacles.solids.push_back(ball());
  const PoseGuard guard(testing::cylinder(2.0, 10.0), obstacles, -0.01);
  const Vec3 axis = Vec3(1.0, 0.2, 0.0).normalized();
  const Pose deep{Vec3(20.5, 0.0, 0.0), axis};
  ASSERT_FALSE(guard.clear(deep));
  const Pose out = slid_clear(guard, deep, 5.0);
  EXPECT_TRUE(guard.clear(out));
  EXPECT_NEAR((out.tip - deep.tip).cross(axis).norm(), 0.0, 1e-9);
  EXPECT_LT((out.tip - deep.tip).norm(), 2.0);
  EXPECT_FALSE(guard.clear(slid_clear(guard, deep, 0.5))) << "no further than allowed";
}

// The reachable part of a target is asked for with this ball: at the waist of a tool, not at a sample of its axis.
TEST(PoseGuard, TheBallHasTheSmallestRadius) {
  const double radius = 5.0, slope = 0.00731, bend = 0.01;
  Tool tool;
  tool.radial = RadialFunction(ToolFamily::kHyperbolic, 20.0, Eigen::Vector3d(radius, slope, bend));
  EXPECT_NEAR(PoseGuard(tool, Obstacles{}, 0.0).ball_radius(), radius - slope * slope / (4.0 * bend), 1e-12);
}

TEST(PoseGuard, AsksTriangles) {
  Obstacles obstacles;
  ObstacleMesh wall;
  wall.mesh = {{Vec3(-50.0, -50.0, 0.0), Vec3(50.0, -50.0, 0.0), Vec3(0.0, 80.0, 0.0)}, {{0, 1, 2}}};
  obstacles.meshes.push_back(wall);
  const PoseGuard guard(testing::cylinder(2.0, 10.0), obstacles, -0.01);
  EXPECT_TRUE(guard.clear({Vec3(0.0, 0.0, 2.1), Vec3::UnitZ()}));
  EXPECT_FALSE(guard.clear({Vec3(0.0, 0.0, 1.9), Vec3::UnitZ()}));
  EXPECT_TRUE(guard.ball_is_clear(Vec3(0.0, 0.0, 2.1)));
  EXPECT_FALSE(guard.ball_is_clear(Vec3(0.0, 0.0, 1.9)));
  EXPECT_TRUE(guard.clear(slid_clear(guard, {Vec3(0.0, 0.0, 1.5), Vec3::UnitZ()}, 5.0)));
}

}  // namespace
}  // namespace flank::internal
