// From faces of a part to what a tool must not enter.
#include "flank/setup/make_obstacles.h"

#include <gtest/gtest.h>

#include "cover/cover_targets.h"
#include "flank/clearance.h"
#include "flank/cover.h"
#include "flank/obstacle/pose_guard.h"
#include "flank/obstacle_field.h"
#include "flank/ruled_motion.h"
#include "obstacle/obstacle_scene.h"

namespace flank::internal {
namespace {

TEST(MakeObstacles, AShankMayTouchWhatItsFlankTouches) {
  constexpr double kTolerance = 0.05, kDeviation = 0.005, kSpare = 0.01;
  Part part;
  part.faces = {testing::flat_face(0.0, 60.0, 0.0, 40.0, 0.0)};
  ObstacleDetail detail;
  detail.own_deviation_mm = kDeviation;
  detail.own_spare_mm = kSpare;
  const auto target = make_target(part.faces);
  const std::vector<ObstacleMesh> own = make_obstacles(part, *target, choose_obstacles({0}, {0}, {}), detail).meshes;
  ASSERT_EQ(own.size(), 1u);
  EXPECT_TRUE(own[0].flank_may_touch);

  Tool tool = testing::cylinder(4.0, 10.0);
  const auto lying_at = [](double height) { return Pose{Vec3(10.0, 20.0, height), Vec3::UnitX()}; };
  EXPECT_TRUE(PoseChecker(tool, own).is_free(lying_at(3.0))) << "the flank is none of its business";
  tool.shank = {{10.0, 4.0}, {30.0, 4.0}};
  const PoseChecker checker(tool, own);
  EXPECT_TRUE(checker.is_free(lying_at(4.0), -0.35 * kTolerance));
  EXPECT_FALSE(checker.is_free(lying_at(4.0 - kTolerance), -0.35 * kTolerance));
  EXPECT_NEAR(checker.measure(lying_at(5.0)).clearance_mm, 1.0 - kSpare, 1e-6) << "a plane has no deviation";
}

TEST(MakeObstacles, ASolidOfWhichAFaceIsNotCheckedIsBared) {
  Part part;
  part.faces = {testing::flat_face(0.0, 60.0, 0.0, 40.0, 0.0), testing::flat_face(0.0, 60.0, 0.0, 40.0, 1.0),
                testing::flat_face(0.0, 60.0, 0.0, 40.0, 2.0), testing::flat_face(0.0, 60.0, 0.0, 40.0, 3.0)};
  part.solids = 2;
  for (std::size_t k = 0; k < part.faces.size(); ++k) {
    part.faces[k].of_solid = true;
    part.faces[k].solid = k < 2 ? 0 : 1;
  }
  ObstacleDetail detail;
  detail.faces_within_mm = 10.0;
  const auto target = make_target({part.faces[0]});
  const auto bared = [&](const std::vector<int>& checks) {
    std::vector<bool> found;
    for (const ObstacleFace& face : make_obstacles(part, *target, choose_obstacles({0}, {0}, checks), detail).faces)
      found.push_back(face.bared);
    return found;
  };
  EXPECT_EQ(bared({1, 2, 3}), (std::vector<bool>{false, false, false}));
  EXPECT_EQ(bared({1, 2}), (std::vector<bool>{false, true}));
}

/// A plane of 24 x 16 mm, and a wall at y = `y` that faces it: part of a vice.
class BesideAVice : public ::testing::Test {
 protected:
  BesideAVice() {
    plane_.faces = {testing::flat_face(0.0, 24.0, 0.0, 16.0, 0.0)};
    target_ = make_target(plane_.faces);
    detail_.faces_within_mm = 12.0;
    detail_.meshes_within_mm = 20.0;
    detail_.deviation_mm = 0.005;
  }
  static Part wall_at(double y) {
    Part part;
    part.file = "vice.step";
    part.faces = {testing::quad(Vec3(-20, y, -5), Vec3(44, y, -5), Vec3(-20, y, 30), Vec3(44, y, 30), "F1")};
    part.faces.front().of_solid = true;
    return part;
  }
  [[nodiscard]] Obstacles obstacles_with(const std::vector<Part>& fixtures, std::optional<double> clearance_mm) {
    ObstacleChoice choice = choose_obstacles({0}, {0}, {});
    choice.fixtures = fixtures;
    choice.clearance_mm = clearance_mm;
    choice.tolerance_mm = kTolerance;
    return make_obstacles(plane_, *target_, choice, detail_);
  }
  /// Lying along x, so that the wall is parallel to the axis.
  static Pose lying_at(double y, double z) { return {Vec3(5.0, y, z), Vec3::UnitX()}; }

  static constexpr double kTolerance = 0.02, kClearance = 1.0;
  static constexpr double kKept = kClearance + 2.0 * kTolerance;  ///< with what a planner holds back
  Part plane_;
  std::unique_ptr<Target> target_;
  ObstacleDetail detail_;
};

TEST_F(BesideAVice, BothPlannersKeepTheSameDistanceFromAFixture) {
  const Obstacles obstacles = obstacles_with({wall_at(17.0)}, kClearance);
  ASSERT_EQ(obstacles.faces.size(), 1u);
  ASSERT_EQ(obstacles.meshes.size(), 1u);
  const ObstacleField field(obstacles, *target_, 3.0, 0.0);
  EXPECT_EQ(field.sign(0), +1) << "the target sees the outside of the vice";
  EXPECT_NEAR(field.at(Vec3(12, 10, 3), 1e3).distance_mm, 7.0 - kKept, 1e-9);
  EXPECT_EQ(field.at(Vec3(12, 10, 3), 5.0).face, -1) << "not nearer than the horizon";
  EXPECT_EQ(field.at(Vec3(12, 10, 3), 6.0).face, 0);
  EXPECT_NEAR(field.at(Vec3(12, 20, 3), 1e3).distance_mm, -3.0 - kKept, 1e-9);
  for (const double y : {16.5, 18.0}) {
    const ObstacleDistance near = field.at(Vec3(12, y, 3), 1e3);
    EXPECT_NEAR((near.gradient + Vec3::UnitY()).norm(), 0.0, 1e-9) << "away from the vice, on either side of it";
  }
  EXPECT_NEAR(field.estimate(Vec3(12, 10, 3)).distance_mm, 7.0 - kKept, 1e-6);
  const PoseGuard guard(testing::cylinder(3.0, 10.0), obstacles, 0.0);
  EXPECT_NEAR(guard.measure(lying_at(10.0, 3.0), 1e3).clearance_mm, 4.0 - kKept, 1e-6);
  EXPECT_FALSE(guard.clear(lying_at(14.0 - 0.99 * kKept, 3.0)));
  EXPECT_TRUE(guard.clear(lying_at(14.0 - 1.01 * kKept, 3.0)));
}

TEST(MakeObstacles, OfAMeshItsTrianglesAreKeptClearOf) {
  // A floor, and beside it a wall of two triangles and one of a corner that stands out by a millimetre, as noise does.
  Part part;
  part.mesh.vertices = {{0, 0, 0},   {20, 0, 0},  {20, 10, 0}, {0, 10, 0}, {0, 11, 0},
                        {20, 11, 0}, {20, 11, 9}, {0, 11, 9},  {10, 10, 4}};
  part.mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 8}, {5, 6, 8}, {6, 7, 8}, {7, 4, 8}};
  part.mesh_faces = {{0, 1}, {2, 3, 4, 5}};
  part.box = part.mesh.box();
  const auto target = make_target({testing::flat_face(0.0, 20.0, 0.0, 10.0, 0.0)});
  ObstacleDetail detail;
  detail.faces_within_mm = 8.0;
  const Obstacles obstacles = make_obstacles(part, *target, choose_obstacles({0}, {0}, {1}), detail);
  ASSERT_EQ(obstacles.faces.size(), 1u);
  const ObstacleField field(obstacles, *target, 2.0, 0.05);
  EXPECT_NEAR(std::abs(field.at(Vec3(10, 7, 4), 1e3).distance_mm), 3.0, 1e-9)
      << "the corner, not a smooth surface near it";
}

TEST_F(BesideAVice, WithoutAClearanceAFixtureMayBeTouched) {
  const Obstacles obstacles = obstacles_with({wall_at(17.0)}, std::nullopt);
  const ObstacleField field(obstacles, *target_, 3.0, 0.0);
  EXPECT_NEAR(field.at(Vec3(12, 10, 3), 1e3).distance_mm, 7.0 - kTolerance, 1e-9);
  EXPECT_TRUE(obstacles_with({}, kClearance).empty());
}

TEST_F(BesideAVice, FixturesFartherThanToolAndClearanceAreLeftOut) {
  // The plane ends at y = 16, its last samples lie a millimetre before: surfaces end 12 mm farther, triangles 20.
  EXPECT_EQ(obstacles_with({wall_at(27.5)}, kClearance).faces.size(), 1u);
  EXPECT_EQ(obstacles_with({wall_at(32.0)}, kClearance).faces.size(), 0u);
  EXPECT_EQ(obstacles_with({wall_at(36.5)}, kClearance).meshes.size(), 1u);
  EXPECT_EQ(obstacles_with({wall_at(50.0)}, kClearance).meshes.size(), 0u);
}

TEST_F(BesideAVice, ShankKeepsTheClearanceFromOtherFacesTheFlankNeedNot) {
  plane_.faces.push_back(wall_at(17.0).faces.front());
  ObstacleChoice choice = choose_obstacles({0}, {0}, {1});
  choice.clearance_mm = kClearance;
  choice.tolerance_mm = kTolerance;
  detail_.own_deviation_mm = 0.005;
  const Obstacles obstacles = make_obstacles(plane_, *target_, choice, detail_);
  Tool tool = testing::cylinder(3.0, 10.0);
  EXPECT_NEAR(PoseGuard(tool, obstacles, 0.0).measure(lying_at(12.0, 9.0), 1e3).clearance_mm, 2.0, 1e-6);
  tool.shank = {{10.0, 3.0}, {20.0, 3.0}};
  EXPECT_NEAR(PoseGuard(tool, obstacles, 0.0).measure(lying_at(12.0, 9.0), 1e3).clearance_mm, 2.0 - kKept, 1e-6);
}

/// What the judge says of strips that were planned around `planned`, beside `vice`.
ClearanceFigure flank_beside(const Part& vice, const CoverResult& planned, const Tool& tool, double required_mm) {
  Path path;
  for (const RuledMotion& motion : planned.motions) {
    path.strips.push_back({});
    path.strips.back().poses = sample_motion(motion, {}).poses;
  }
  const BSplineSurface& wall = vice.faces.front().surface;
  Obstacle obstacle{"vice", ObstacleRole::kFixture, {wall.poles, {{0, 1, 2}, {2, 1, 3}}}};
  ClearanceOptions options;
  options.tolerance_mm = 0.02;
  options.required_mm = required_mm;
  return judge_clearance(tool, path, {obstacle}, options).figures.front();
}

TEST_F(BesideAVice, CoverClearsAFixtureThatItWouldEnter) {
  const Part vice = wall_at(17.0);
  const Tool tool = testing::cylinder(3.0, 10.0);
  CoverOptions options;
  options.tolerance_mm = kTolerance;
  options.seed_places = options.seed_directions = 2;
  options.seed_spheres = 1;
  options.sample_share = 0.06;
  options.dense_share = 0.05;
  options.control_points = 8;
  options.most_strips = 3;
  options.smooth = false;
  const CoverResult blind = cover(*target_, tool, {}, options, {});
  ASSERT_EQ(blind.status, CoverStatus::kCovered) << blind.message;
  EXPECT_LT(flank_beside(vice, blind, tool, kClearance).clearance_mm, 0.0) << "or the test shows nothing";
  const CoverResult seeing = cover(*target_, tool, obstacles_with({vice}, kClearance), options, {});
  ASSERT_EQ(seeing.status, CoverStatus::kCovered) << seeing.message;
  const ClearanceFigure figure = flank_beside(vice, seeing, tool, kClearance);
  EXPECT_TRUE(figure.kept) << figure.clearance_mm << " less " << figure.bound_mm;
  EXPECT_NEAR(seeing.reachable, (17.0 - kClearance - 3.0) / 16.0, 0.05);
  EXPECT_GE(seeing.coverage, 0.9) << "of what can be reached";
}

}  // namespace
}  // namespace flank::internal
