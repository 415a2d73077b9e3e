// Starts beside walls: the tip where the ball touches the hub, the rest of the axis past the free end.
#include "flank/seed/clear_start.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "obstacle/obstacle_scene.h"

namespace flank::internal {
namespace {

using testing::hub;
using testing::only;
using testing::plates;
using testing::standing_blade;

class ClearStartTest : public ::testing::TestWithParam<double> {};

/// Blades that stand on the hub, and in it.
INSTANTIATE_TEST_SUITE_P(Bottoms, ClearStartTest, ::testing::Values(0.0, -10.0));

TEST_P(ClearStartTest, TipRollsAlongTheHub) {
  const auto blade = standing_blade(GetParam());
  const ObstacleField obstacles(only(hub(true)), *blade, 2.0, 0.0);
  const Chart chart(*blade);
  int upright = 0;
  for (const bool swapped : {false, true}) {
    RuledStart start;
    start.swapped = swapped;
    start.radius_mm = 3.0;
    const ClearStart clear = clear_start(chart, start, obstacles);
    ASSERT_GT(clear.free_lines, 0);
    if (!clear.lines.front().low_blocked && !clear.lines.front().high_blocked) continue;  // lines along the hub
    ++upright;
    EXPECT_NEAR(clear.longest_mm, 37.0, 0.2);  // the chart ends half a percent short
    const double length = 1.03 * clear.longest_mm;
    const RuledMotion motion = make_motion(clear, length, 12);
    for (int i = 0; i <= 20; ++i) {
      const Pose pose = motion.pose(i / 20.0);
      EXPECT_NEAR(pose.tip.z(), 3.0, 0.02);
      EXPECT_NEAR(pose.tip.y(), 3.0, 1e-6);
      EXPECT_NEAR(pose.axis.z(), 1.0, 1e-6);
    }
  }
  EXPECT_EQ(upright, 1);
}

/// Upright lines end at plates by as much as the ball is thick, whatever that is: half a radius is left to the fit.
TEST(ClearStart, EndsBeforePlatesHoweverThinTheBall) {
  const auto blade = standing_blade(0.0);
  const ObstacleField obstacles(plates(), *blade, 2.0, 0.0);
  const Chart chart(*blade);
  for (const double radius : {0.3, 1.0, 6.0}) {
    int upright = 0;
    for (const bool swapped : {false, true}) {
      RuledStart start;
      start.swapped = swapped;
      start.radius_mm = radius;
      const ClearStart clear = clear_start(chart, start, obstacles);
      ASSERT_GT(clear.free_lines, 0);
      if (std::abs(clear.lines.front().axis.direction.z()) < 0.9) continue;  // across, from plate to plate
      ++upright;
      const double a = clear.lines.front().axis.middle.x(), b = clear.lines.back().axis.middle.x();
      EXPECT_NEAR(std::min(a, b), 0.5 * radius, 0.2) << radius;
      EXPECT_NEAR(std::max(a, b), 60.0 - 0.5 * radius, 0.2) << radius;
    }
    EXPECT_EQ(upright, 1);
  }
}

TEST(ClearStart, NothingIsFreeInsideTheHub) {
  const auto blade = standing_blade(0.0);
  const ObstacleField obstacles(only(hub(true)), *blade, 2.0, 0.0);
  const Chart chart(*blade);
  RuledStart start;
  start.radius_mm = 60.0;  // larger than the blade is high
  EXPECT_EQ(clear_start(chart, start, obstacles).free_lines, 0);
}

}  // namespace
}  // namespace flank::internal
