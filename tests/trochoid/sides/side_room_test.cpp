// What the sides of a cavity leave to a tool: a thick end keeps off a wall, a narrow place leaves no way across.
#include "flank/trochoid/sides/side_room.h"

#include <gtest/gtest.h>

#include "flank/trochoid/sides/side_fit.h"
#include "obstacle/obstacle_scene.h"

namespace flank::internal {
namespace {

constexpr double kHeight = 40.0;

/// Upright along the blade, so far off it.
RuledMotion upright(double y) {
  std::vector<Pose> poses;
  std::vector<double> t;
  for (int k = 0; k <= 20; ++k) {
    t.push_back(k / 20.0);
    poses.push_back({Vec3(60.0 * t.back(), y, 0.0), Vec3::UnitZ()});
  }
  return fit_motion(poses, t, kHeight, 6);
}

/// Radius 2 at the tip, 6 at the holder's end.
RadialFunction cone() { return {ToolFamily::kCone, kHeight, Eigen::Vector2d(2.0, std::atan(0.1))}; }

TEST(ReachOfTool, IsThatOfTheRadiusAtThePlace) {
  const std::unique_ptr<Target> blade = testing::standing_blade(0.0);
  const Face wall = testing::quad(Vec3(60, 50, -10), Vec3(60, -50, -10), Vec3(60, 50, 60), Vec3(60, -50, 60), "F3");
  const ObstacleField field(testing::only({make_target({wall}), true}), *blade, 8.0, 0.0);
  const CavitySide side{blade.get(), &field};
  const std::vector<RuledMotion> motions = {upright(4.0), upright(4.0)};
  EXPECT_NEAR(reach_of_tool(side, side, motions, cone()), 1.0 - 4.0 / 60.0, 0.02) << "radii of 4 mm on average";
  EXPECT_NEAR(reachable_share(side, side, 2.0), 1.0 - 2.0 / 60.0, 0.02);
  const RadialFunction cylinder(ToolFamily::kCylinder, kHeight, Eigen::VectorXd::Constant(1, 2.0));
  EXPECT_DOUBLE_EQ(reach_of_tool(side, side, motions, cylinder), reachable_share(side, side, 2.0));
  EXPECT_EQ(reach_of_tool(side, side, {}, cylinder), 0.0);
}

TEST(BlockedShare, IsWhereABladeStandsBetween) {
  const std::unique_ptr<Target> blade = testing::standing_blade(0.0);
  const std::unique_ptr<Target> other =
      make_target({testing::quad(Vec3(0, 16, 0), Vec3(60, 16, 0), Vec3(0, 16, 40), Vec3(60, 16, 40), "F2")});
  const Face splitter = testing::quad(Vec3(20, 7, -5), Vec3(60, 9, -5), Vec3(20, 7, 45), Vec3(60, 9, 45), "F3");
  const ObstacleField field(testing::only({make_target({splitter}), false}), *blade, 4.0, 0.0);
  const ObstacleField floor(testing::only(testing::hub(true)), *blade, 4.0, 0.0);
  EXPECT_NEAR(blocked_share({blade.get(), &field}, {other.get(), nullptr}), 40.0 / 60.0, 0.05);
  EXPECT_LT(blocked_share({blade.get(), &floor}, {other.get(), nullptr}), 0.1) << "a floor is no blade";
  EXPECT_EQ(blocked_share({blade.get(), nullptr}, {other.get(), nullptr}), 0.0);
}

TEST(CoveredInReach, CountsWhereTheBallFits) {
  const std::unique_ptr<Target> blade = testing::standing_blade(0.0);
  const Face wall = testing::quad(Vec3(60, 50, -10), Vec3(60, -50, -10), Vec3(60, 50, 60), Vec3(60, -50, 60), "F3");
  const ObstacleField field(testing::only({make_target({wall}), true}), *blade, 20.0, 0.0);
  const CavitySide side{blade.get(), &field};
  const RadialFunction tool(ToolFamily::kCylinder, kHeight, Eigen::VectorXd::Constant(1, 2.0));
  std::vector<RuledMotion> motions = {upright(2.0), upright(2.0)};  // into the wall: all along the blade
  for (const double radius : {2.0, 10.0})
    EXPECT_NEAR(covered_in_reach(side, side, motions, tool, 0.01, radius), 1.0 - radius / 60.0, 0.02) << radius;
  motions = {upright(3.0), upright(3.0)};
  EXPECT_EQ(covered_in_reach(side, side, motions, tool, 0.01, 10.0), 1.0) << "nothing is covered";
}

TEST(Lying, CountsAllLayersTogether) {
  // 40 mm long on 60 mm of way: two such, one above the other, are as deep as a third more than the cavity is long; three lie behind one
  // another between walls that are 60 mm deep.
  const RuledMotion side = upright(4.0);
  EXPECT_EQ(lying({}), 0.0);
  EXPECT_EQ(lying({side, side}), 0.0);
  EXPECT_NEAR(lying({side, side, side, side}), 2.0 * kHeight / 60.0 - 1.3, 0.01);
  EXPECT_NEAR(lying({side, side, side, side, side, side}), 3.0 * kHeight / 60.0 - 1.3, 0.01);
}

TEST(LeastWayAcross, IsInDiametersAtTheNarrowestHeight) {
  const std::vector<RuledMotion> motions = {upright(6.0), upright(12.0)};
  EXPECT_NEAR(least_way_across(motions, cone()), 6.0 / 12.0, 0.02) << "where the cone is 12 mm thick";
}

}  // namespace
}  // namespace flank::internal
