// From faces of a part to what a tool must not enter.
#include "flank/setup/make_obstacles.h"

#include <gtest/gtest.h>

#include "cover/cover_targets.h"
#include "flank/obstacle/pose_clearance.h"

namespace flank::internal {
namespace {

TEST(MakeObstacles, AShankMayTouchWhatItsFlankTouches) {
  constexpr double kTolerance = 0.05, kDeviation = 0.005, kSpare = 0.01;
  Part part;
  part.faces = {testing::flat_face(0.0, 60.0, 0.0, 40.0, 0.0)};
  ObstacleDetail detail;
  detail.own_deviation_mm = kDeviation;
  detail.own_spare_mm = kSpare;
  std::vector<std::string> notes;
  const auto target = make_target(part.faces);
  const std::vector<ObstacleMesh> own =
      make_obstacles(part, *target, choose_obstacles({0}, {0}, {}), detail, notes).meshes;
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

}  // namespace
}  // namespace flank::internal
