// How wide a cavity is: where a tool comes, not where another face covers a side.
#include "flank/trochoid/sides/side_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "flank/example/example_cavity.h"
#include "flank/motion/stagger.h"
#include "obstacle/obstacle_scene.h"
#include "sanitized.h"

namespace flank::internal {
namespace {

using testing::hub;
using testing::only;
using testing::quad;
using testing::standing_blade;

/// Across from the standing blade: 1 mm away at z = -10, 11 mm at z = 40, looking back at it.
std::unique_ptr<Target> leaning_wall() {
  return make_target({quad(Vec3(0, 1, -10), Vec3(60, 1, -10), Vec3(0, 11, 40), Vec3(60, 11, 40), "F3")});
}

TEST(WidthBetween, CountsWhatNothingCovers) {
  const std::unique_ptr<Target> blade = standing_blade(-10.0), wall = leaning_wall();
  const CavityWidth all = width_between({blade.get(), nullptr}, {wall.get(), nullptr});
  // Distances are across the wall, which leans by 0.2.
  const double across = 1.0 / std::sqrt(1.0 + 0.2 * 0.2);
  EXPECT_NEAR(all.narrowest_mm, 1.0 * across, 0.25);
  EXPECT_NEAR(all.median_mm, 6.0 * across, 0.25);
  const ObstacleField floor(only(hub(true)), *blade, 2.0, 0.0);
  const CavityWidth free = width_between({blade.get(), &floor}, {wall.get(), nullptr});
  EXPECT_GE(free.narrowest_mm, 3.0 * across) << "below the hub nothing is milled";
  EXPECT_LE(free.narrowest_mm, 3.8 * across);
  EXPECT_GT(free.median_mm, all.median_mm);
}

/// Hollow walls leave open how far an axis leans along them; the cycles between them do not.
TEST(FitSides, LeavesTheAxesParallelWhereTheWallsAllowIt) {
  if (kSanitized) GTEST_SKIP() << "on the path of AreDoneWithWhatTheirToolReaches";
  const std::vector<Face> walls = cavity_walls({});
  const std::unique_ptr<Target> left = make_target({walls[0]}), right = make_target({walls[1]});
  SideFitOptions options;
  options.fit.tolerance_mm = 0.02;
  options.fit.bounds.smallest = 3.0;
  options.fit.bounds.largest = 9.0;
  options.starts = {{8.0, 0.3}};
  const SideFit sides = fit_sides({left.get(), nullptr}, {right.get(), nullptr}, {}, options, {});
  ASSERT_EQ(sides.fit.motions.size(), 2u);
  EXPECT_GT(sides.fit.after.at_tolerance, 0.99);
  EXPECT_LT(sides.fit.after.stagger, 0.01) << "the walls alone lead to 0.1";
  EXPECT_EQ(sides.fit.after.stagger, mean_stagger(sides.fit.motions));
}

/// Between a bound of the radius and one of slenderness that no tool keeps both fits went astray, and covered nothing.
TEST(FitSides, NoTwoBoundsThatNoToolKeepsHoldOneAnother) {
  if (kThreadSanitized) GTEST_SKIP() << "its parallel loops are those of fit";
  const std::vector<Face> walls = cavity_walls({});
  const std::unique_ptr<Target> left = make_target({walls[0]}), right = make_target({walls[1]});
  const CavitySide a{left.get(), nullptr}, b{right.get(), nullptr};
  SideFitOptions options;
  options.fit.tolerance_mm = 0.02;
  options.fit.bounds.smallest = 0.5;
  options.fit.bounds.largest = 1.5;
  options.fit.bounds.slenderest = 8.0;
  options.starts = {{1.4, 0.3}};
  options.slender = false;
  EXPECT_TRUE(fit_sides(a, b, {}, options, {}).fit.motions.empty()) << "more layers have a shorter tool";
  options.slender = true;
  const SideFit sides = fit_sides(a, b, {}, options, {});
  ASSERT_EQ(sides.fit.motions.size(), 2u);
  EXPECT_GT(sides.fit.after.at_tolerance, 0.95);
  EXPECT_LE(sides.fit.tool.largest(), 1.5 + 1e-6);
}

/// A thin tool reaches more of a wall that stands on a floor, which is no reason to leave a stout one that covers what it reaches.
TEST(FitSides, AreDoneWithWhatTheirToolReaches) {
  if (kThreadSanitized) GTEST_SKIP() << "its parallel loops are those of fit";
  const std::vector<Face> walls = cavity_walls({24.0, 30.0, 40.0, 0.0, 4.0, 0.0});
  const std::unique_ptr<Target> left = make_target({walls[0]}), right = make_target({walls[1]});
  const auto floor = [] {
    return ObstacleFace{
        make_target({quad(Vec3(-80, -80, -12), Vec3(80, -80, -12), Vec3(-80, 80, -12), Vec3(80, 80, -12), "F3")}),
        true};
  };
  const double thickest = 5.0, tolerance = 0.02;
  const ObstacleField on_left(only(floor()), *left, thickest, tolerance);
  const ObstacleField on_right(only(floor()), *right, thickest, tolerance);
  const CavitySide a{left.get(), &on_left}, b{right.get(), &on_right};
  SideFitOptions options;
  options.fit.tolerance_mm = tolerance;
  options.fit.bounds.smallest = 0.5;
  options.fit.bounds.largest = thickest;
  options.starts = {{4.6, 0.55}, {4.6, 0.3}};
  options.least_coverage = 0.95;
  options.up = Vec3::UnitZ();
  const SideFit sides = fit_sides(a, b, {}, options, {});
  ASSERT_EQ(sides.fit.motions.size(), 2u);
  EXPECT_LT(reachable_share(a, b, sides.fit.tool.smallest()), 0.9) << "the tool cannot cover the share of the whole";
  EXPECT_EQ(sides.tried_radii, 1);
  EXPECT_GT(sides.fit.tool.smallest(), 0.5 * 4.6);
}

/// Deep hollows begin badly along the walls, and well across them: of the ways across, two that are each other's mirror image
/// took both places, and the tool lay along the cavity.
TEST(FitSides, TryAnotherWayThanTwoThatAreMirrorImages) {
  if (kSanitized) GTEST_SKIP() << "on the path of AreDoneWithWhatTheirToolReaches";
  CavityShape deep;
  deep.hollow_mm = 3.0;
  const std::vector<Face> walls = cavity_walls(deep);
  const std::unique_ptr<Target> left = make_target({walls[0]}), right = make_target({walls[1]});
  SideFitOptions options;
  options.fit.tolerance_mm = 0.02;
  options.fit.bounds.smallest = 0.7;
  options.fit.bounds.largest = 8.68;
  options.starts = {{8.0, 0.3}};
  const SideFit sides = fit_sides({left.get(), nullptr}, {right.get(), nullptr}, {}, options, {});
  ASSERT_EQ(sides.fit.motions.size(), 2u);
  EXPECT_GT(sides.fit.motions.front().pose(0.5).axis.z(), 0.9) << "upright";
  EXPECT_GT(sides.fit.after.at_tolerance, 0.8);
}

/// The last passes took longer than all before them, of every number of layers that covered too little.
TEST(FitSides, LeaveTheLastPassesToThoseThatAreMilled) {
  if (kSanitized) GTEST_SKIP() << "on the path of AreDoneWithWhatTheirToolReaches";
  const std::vector<Face> walls = cavity_walls({24.0, 30.0, 40.0, 10.0, 4.0, 1.0});
  const std::unique_ptr<Target> left = make_target({walls[0]}), right = make_target({walls[1]});
  const CavitySide a{left.get(), nullptr}, b{right.get(), nullptr};
  SideFitOptions options;
  options.fit.tolerance_mm = 0.002;
  options.fit.bounds.smallest = 4.55;  // hardly more than a cylinder
  options.fit.bounds.largest = 4.6;
  options.fit.sample_share *= 3.0;
  options.starts = {{4.6, 0.9}};
  const SideFit sides = fit_sides(a, b, {}, options, {});
  ASSERT_EQ(sides.fit.motions.size(), 2u);
  EXPECT_LT(sides.fit.after.at_tolerance, 0.8);
  EXPECT_FALSE(sides.settled);
  const SideFit later = settle_sides(a, b, sides, options, {});
  EXPECT_TRUE(later.settled);
  options.least_coverage = 0.01;
  const SideFit at_once = fit_sides(a, b, {}, options, {});
  EXPECT_TRUE(at_once.settled) << "it covers what is asked";
  EXPECT_EQ(later.fit.after.at_tolerance, at_once.fit.after.at_tolerance);
  EXPECT_EQ(later.fit.tool.parameters(), at_once.fit.tool.parameters());
  EXPECT_EQ(later.fit.motions.front().pose(0.3).tip, at_once.fit.motions.front().pose(0.3).tip);
}

TEST(WidthBetween, IsNoneWhereEverythingIsCovered) {
  const std::unique_ptr<Target> wall = leaning_wall();
  const std::unique_ptr<Target> buried =
      make_target({quad(Vec3(60, 0, -40), Vec3(0, 0, -40), Vec3(60, 0, -5), Vec3(0, 0, -5), "F1")});
  const ObstacleField floor(only(hub(true)), *standing_blade(0.0), 2.0, 0.0);
  EXPECT_EQ(width_between({buried.get(), &floor}, {wall.get(), nullptr}).narrowest_mm, 0.0);
}

}  // namespace
}  // namespace flank::internal
