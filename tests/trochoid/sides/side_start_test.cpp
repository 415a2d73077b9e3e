// Where the axis begins on both sides of a cavity: before the walls that close its ends.
#include "flank/trochoid/sides/side_start.h"

#include <gtest/gtest.h>

#include <cmath>

#include "flank/example/example_cavity.h"

namespace flank::internal {
namespace {

TEST(SideStart, BeginsAndEndsBeforeWallsAcrossTheWay) {
  constexpr double kRadius = 8.0;
  const std::vector<Face> faces = cavity_walls({.end_wall = true, .start_wall = true});
  const std::unique_ptr<Target> left = make_target({faces[0]}), right = make_target({faces[1]});
  const auto walls = [&] {
    Obstacles out;
    for (const std::size_t k : {2, 3}) out.faces.push_back({make_target({faces[k]}), true});
    return out;
  };
  const ObstacleField at_left(walls(), *left, 12.0, 0.0), at_right(walls(), *right, 12.0, 0.0);
  const auto same = [](double length) { return length; };
  int upright = 0;
  for (const bool swapped : {false, true}) {
    const std::vector<FitTask> tasks = side_tasks({left.get(), &at_left}, {right.get(), &at_right}, Chart(*left),
                                                  Chart(*right), {swapped, 0.0, kRadius}, 1, same, {});
    ASSERT_EQ(tasks.size(), 2u);
    if (tasks.front().motion.pose(0.5).axis.z() < 0.9) continue;
    ++upright;
    for (const FitTask& task : tasks)
      for (const double t : {0.0, 1.0}) {
        // The axis leans with the wall: its middle counts.
        const double x = task.motion.pose(t).at(0.5 * task.motion.axis_length).x();
        EXPECT_LT(std::abs(x) + kRadius, 25.0) << t;
        EXPECT_GT(std::abs(x) + kRadius, 23.0) << "and no farther from it than it takes";
      }
  }
  EXPECT_EQ(upright, 1);
}

TEST(SideStart, DoesNotGoUpAWallThatItsLinesLeanAgainst) {
  constexpr double kRadius = 2.7;
  const std::vector<Face> faces = cavity_walls(
      {.width_mm = 12.0, .depth_mm = 30.0, .length_mm = 40.0, .twist_deg = 15.0, .hollow_mm = 0.5, .end_wall = true});
  const std::unique_ptr<Target> left = make_target({faces[0]}), right = make_target({faces[1]});
  // At its bottom the cavity is narrower than the tool: the other side is a floor.
  const auto around = [&](std::size_t other) {
    Obstacles out;
    for (const std::size_t k : {other, std::size_t{2}}) out.faces.push_back({make_target({faces[k]}), false});
    return out;
  };
  const ObstacleField at_left(around(1), *left, 4.0, 0.0), at_right(around(0), *right, 4.0, 0.0);
  const auto same = [](double length) { return length; };
  int upright = 0;
  for (const bool swapped : {false, true})
    for (const double skew : {0.0, 0.2, -0.2, 0.4, -0.4}) {
      const std::vector<FitTask> tasks = side_tasks({left.get(), &at_left}, {right.get(), &at_right}, Chart(*left),
                                                    Chart(*right), {swapped, skew, kRadius}, 1, same, {});
      ASSERT_EQ(tasks.size(), 2u);
      if (tasks.front().motion.pose(0.5).axis.z() < 0.85) continue;
      ++upright;
      for (const FitTask& task : tasks) {
        const auto height = [&](double t) { return task.motion.pose(t).at(0.5 * task.motion.axis_length).z(); };
        EXPECT_NEAR(height(1.0), height(0.5), 14.0) << "skew " << skew;
      }
    }
  EXPECT_EQ(upright, 5);
}

}  // namespace
}  // namespace flank::internal
