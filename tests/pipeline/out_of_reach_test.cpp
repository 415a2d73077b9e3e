// A target that another face covers, as of a surface that a designer left in the file.
#include "flank/pipeline/search/out_of_reach.h"

#include <gtest/gtest.h>

#include "obstacle/obstacle_scene.h"
#include "verify/faces.h"

namespace flank::internal {
namespace {

using testing::hub;
using testing::only;
using testing::quad;
using testing::standing_blade;

TEST(OutOfReach, SeesAFaceThatLiesUponTheTargetAndNotAHubBesideIt) {
  const auto blade = standing_blade(0.0);
  FlankFitOptions options;
  options.tolerance_mm = 0.02;
  options.reach_radius_mm = 2.0;
  EXPECT_EQ(reachable_share(*blade, options), 1.0);
  const ObstacleField beside(only(hub(true)), *blade, 2.0, 0.0);
  options.obstacles = &beside;
  EXPECT_NEAR(reachable_share(*blade, options), 38.0 / 40.0, 0.02);
  // A hundredth of a tool's radius in front of it.
  const Face copy = quad(Vec3(70, 0.1, -9), Vec3(-9, 0.1, -9), Vec3(70, 0.1, 50), Vec3(-9, 0.1, 50), "F2");
  const ObstacleField upon(only({make_target({copy}), false}), *blade, 2.0, 0.0);
  options.obstacles = &upon;
  EXPECT_LT(reachable_share(*blade, options), kHardlyAny);
  EXPECT_NE(out_of_reach_note(0.0, options).find("100.0 %"), std::string::npos);
}

TEST(OutOfReach, SeesTheTargetsOwnCorner) {
  const auto corner = make_target({test::corner_face("F1", 20.0, 30.0)});
  FlankFitOptions options;
  options.tolerance_mm = 0.02;
  options.reach_radius_mm = 5.0;
  EXPECT_NEAR(reachable_share(*corner, options), 1.0 - 5.0 / 20.0, 0.03);
}

TEST(OutOfReach, AGrooveIsAskedForWithABallThatFitsIt) {
  Face groove = test::quarter_cylinder("F1", 5.0, 300.0);
  groove.reversed = true;  // towards the axis
  const auto target = make_target({groove});
  FlankFitOptions options;
  options.tolerance_mm = 0.02;
  const double ball = ball_with_room(*target, options, 8.0);
  EXPECT_GT(ball, 0.85 * 5.0);
  EXPECT_LE(ball, 5.1);
  EXPECT_EQ(ball_with_room(*target, options, 4.0), 4.0);
  EXPECT_EQ(ball_with_room(*standing_blade(0.0), options, 8.0), 8.0);
}

TEST(OutOfReach, AWallOfASlotIsAskedForWithABallThatFitsBetween) {
  // The other wall, 3 mm away.
  const Face wall = quad(Vec3(70, 3, -9), Vec3(-9, 3, -9), Vec3(70, 3, 50), Vec3(-9, 3, 50), "F2");
  const auto blade = standing_blade(0.0);
  const ObstacleField beside(only({make_target({wall}), false}), *blade, 1.0, 0.0);
  FlankFitOptions options;
  options.tolerance_mm = 0.02;
  options.obstacles = &beside;
  const double ball = ball_with_room(*blade, options, 4.0);
  EXPECT_GT(ball, 0.85 * 1.5);
  EXPECT_LE(ball, 1.52);
}

}  // namespace
}  // namespace flank::internal
