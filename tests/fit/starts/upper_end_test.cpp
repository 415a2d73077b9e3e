// Which end of an axis is the upper one: where a line along it is free.
#include "flank/fit/starts/upper_end.h"

#include <gtest/gtest.h>

#include "fit/flat_scene.h"

namespace flank::internal {
namespace {

using testing::standing_blade;
using testing::upright_motion;

/// Nothing but a ceiling, or a floor, at a height: lines that go through it are not free.
FlankFitOptions beside_plane(double height, double first_x = -1e9, double last_x = 1e9) {
  FlankFitOptions options;
  options.is_free_line = [=](const Vec3& from, const Vec3& direction) {
    const double way = (height - from.z()) / direction.z();
    const double x = from.x() + way * direction.x();
    return !(way > 0.0 && x >= first_x && x <= last_x);
  };
  return options;
}

FitTask upright_task(const Target& target) {
  return {&target, upright_motion({.y = 5.0, .z = -1.0, .x_first = 0.0, .x_last = 60.0, .length = 42.0}), nullptr};
}

TEST(UpperEnd, AMotionTurnedOverHasTheSameAxesAndTurnedTwiceIsItself) {
  const auto blade = standing_blade(0.0);
  const RuledMotion motion = upright_task(*blade).motion, over = turned_over(motion), back = turned_over(over);
  for (const double t : {0.0, 0.3, 1.0}) {
    EXPECT_LT((over.pose(t).tip - motion.pose(t).at(42.0)).norm(), 1e-9);
    EXPECT_LT((over.pose(t).axis + motion.pose(t).axis).norm(), 1e-12);
    EXPECT_LT((back.pose(t).tip - motion.pose(t).tip).norm(), 1e-9);
  }
}

TEST(UpperEnd, TheShareOfTheMotionThatRunsIntoSomethingIsCounted) {
  const auto blade = standing_blade(0.0);
  const RuledMotion motion = upright_task(*blade).motion;
  EXPECT_EQ(unheld_share(motion, FlankFitOptions()), 0.0);
  EXPECT_EQ(unheld_share(motion, beside_plane(100.0)), 1.0);
  EXPECT_EQ(unheld_share(motion, beside_plane(-100.0)), 0.0);
  EXPECT_NEAR(unheld_share(motion, beside_plane(100.0, 30.0, 90.0)), 0.5, 0.05);
  // A line passes beside what a rod runs into.
  const RadialFunction tool(ToolFamily::kCylinder, motion.axis_length, Eigen::VectorXd::Constant(1, 10.0));
  EXPECT_EQ(unheld_share(motion, beside_plane(100.0, 60.5, 90.0)), 0.0);
  EXPECT_GT(unheld_share({motion}, tool, beside_plane(100.0, 60.5, 90.0)), 0.0);
  EXPECT_EQ(unheld_share({motion}, tool, beside_plane(100.0, 61.5, 90.0)), 0.0);
}

TEST(UpperEnd, ATaskUnderACeilingIsTurnedOverOneAboveAFloorIsNot) {
  const auto blade = standing_blade(0.0);
  std::vector<FitTask> tasks = {upright_task(*blade)};
  hold_from_free_end(beside_plane(-100.0), tasks);
  EXPECT_GT(tasks[0].motion.pose(0.5).axis.z(), 0.9);
  hold_from_free_end(beside_plane(100.0), tasks);
  EXPECT_LT(tasks[0].motion.pose(0.5).axis.z(), -0.9);
  EXPECT_EQ(unheld_share(tasks[0].motion, beside_plane(100.0)), 0.0);
}

}  // namespace
}  // namespace flank::internal
