// Where the axis begins on both sides of a cavity: before the walls that close its ends.
#include "flank/trochoid/sides/side_start.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "flank/example/example_cavity.h"
#include "obstacle/obstacle_scene.h"

namespace flank::internal {
namespace {

/// Both ways to lay a stout axis on two sides, of those the ones that stand along z.
std::vector<std::vector<FitTask>> upright_starts(const CavitySide& left, const CavitySide& right, double radius) {
  const auto same = [](double length) { return length; };
  std::vector<std::vector<FitTask>> out;
  for (const bool swapped : {false, true}) {
    const std::vector<FitTask> tasks =
        side_tasks(left, right, Chart(*left.target), Chart(*right.target), {swapped, 0.0, radius}, 1, same, {});
    EXPECT_EQ(tasks.size(), 2u);
    if (tasks.size() == 2 && std::abs(tasks.front().motion.pose(0.5).axis.z()) >= 0.9) out.push_back(tasks);
  }
  return out;
}

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
  const auto upright = upright_starts({left.get(), &at_left}, {right.get(), &at_right}, kRadius);
  ASSERT_EQ(upright.size(), 1u);
  for (const FitTask& task : upright.front())
    for (const double t : {0.0, 1.0}) {
      // The axis leans with the wall: its middle counts.
      const double x = task.motion.pose(t).at(0.5 * task.motion.axis_length).x();
      EXPECT_LT(std::abs(x) + kRadius, 25.0) << t;
      EXPECT_GT(std::abs(x) + kRadius, 23.0) << "and no farther from it than it takes";
    }
}

TEST(SideStart, AConeTouchesBothSidesFromItsThinTipUp) {
  // Walls that come together towards the floor: there a cylinder of 6 mm has hardly any room.
  constexpr double kRadius = 6.0, kTip = 2.0;
  const std::vector<Face> faces = cavity_walls({.twist_deg = 0.0, .lean_deg = 12.0});
  const std::unique_ptr<Target> left = make_target({faces[0]}), right = make_target({faces[1]});
  const auto same = [](double length) { return length; };
  int upright = 0;
  for (const bool swapped : {false, true}) {
    const std::vector<FitTask> tasks =
        side_tasks({left.get(), nullptr}, {right.get(), nullptr}, Chart(*left), Chart(*right),
                   {swapped, 0.0, kRadius, kTip}, 1, same, Vec3(0.0, 0.0, 1.0));
    ASSERT_EQ(tasks.size(), 2u);
    if (tasks.front().motion.pose(0.5).axis.z() < 0.8) continue;
    ++upright;
    for (const FitTask& task : tasks)
      for (const double share : {0.1, 0.5, 0.9}) {
        // The walls are hollow by a millimetre.
        const Vec3 place = task.motion.pose(0.5).at(share * task.motion.axis_length);
        EXPECT_NEAR(task.target->closest(place).distance, std::lerp(kTip, kRadius, share), 1.0) << swapped << share;
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

TEST(SideStart, LaysBothSidesSoThatTheToolGoesTheSameWay) {
  // Lines lean by 40 degrees to either side: those along the right wall are more nearly parallel to the left one's than those
  // that stand as they do.
  const double lean = 40.0 * std::numbers::pi / 180.0;
  const auto wall = [&](double y, double sign, const char* id) {
    const Vec3 at(0.0, y, 0.0), along(100.0, 0.0, 0.0), up(sign * 60.0 * std::sin(lean), 0.0, 60.0 * std::cos(lean));
    return testing::quad(at, at + along, at + up, at + along + up, id);
  };
  Face right_wall = wall(40.0, -1.0, "F2");
  right_wall.reversed = true;
  const std::unique_ptr<Target> left = make_target({wall(0.0, 1.0, "F1")}), right = make_target({right_wall});
  const auto same = [](double length) { return length; };
  for (const bool swapped : {false, true}) {
    const std::vector<FitTask> tasks = side_tasks({left.get(), nullptr}, {right.get(), nullptr}, Chart(*left),
                                                  Chart(*right), {swapped, 0.0, 5.0}, 1, same, {});
    ASSERT_EQ(tasks.size(), 2u);
    const auto way = [&](std::size_t m) {
      const RuledMotion& motion = tasks[m].motion;
      const double middle = 0.5 * motion.axis_length;
      return Vec3((motion.pose(1.0).at(middle) - motion.pose(0.0).at(middle)).normalized());
    };
    EXPECT_GT(way(0).dot(way(1)), swapped ? 0.1 : 0.99);
  }
}

TEST(SideStart, EndsBeforeTheCornerWithAWallThatItsLinesRunAlong) {
  // The wall is hollow: where a ball hardly fits between it and a side, it does half way up alone, as far as the side goes.
  constexpr double kRadius = 8.0, kDepth = 40.0;
  const std::unique_ptr<Target> left = testing::standing_blade(0.0);
  const std::unique_ptr<Target> right =
      make_target({testing::quad(Vec3(0, 40, 0), Vec3(60, 40, 0), Vec3(0, 40, kDepth), Vec3(60, 40, kDepth), "F2")});
  const auto wall = [&] {
    Obstacles out;
    for (const double end : {-kDepth, kDepth}) {
      const double z = 0.5 * kDepth + end;
      out.faces.push_back(
          {make_target({testing::quad(Vec3(72, -50, 20), Vec3(72, 90, 20), Vec3(32, -50, z), Vec3(32, 90, z), "F3")}),
           false});
    }
    return out;
  };
  const ObstacleField at_left(wall(), *left, 12.0, 0.0), at_right(wall(), *right, 12.0, 0.0);
  const auto upright = upright_starts({left.get(), &at_left}, {right.get(), &at_right}, kRadius);
  ASSERT_EQ(upright.size(), 1u);
  for (const FitTask& task : upright.front())
    for (const double t : {0.0, 1.0})
      EXPECT_NEAR(task.motion.pose(t).tip.z(), task.motion.pose(0.5).tip.z(), 0.3 * kDepth) << t;
}

}  // namespace
}  // namespace flank::internal
