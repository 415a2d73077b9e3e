// How wide a cavity is: where a tool comes, not where another face covers a side.
#include "flank/trochoid/side_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "obstacle/obstacle_scene.h"

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

TEST(WidthBetween, IsNoneWhereEverythingIsCovered) {
  const std::unique_ptr<Target> wall = leaning_wall();
  const std::unique_ptr<Target> buried =
      make_target({quad(Vec3(60, 0, -40), Vec3(0, 0, -40), Vec3(60, 0, -5), Vec3(0, 0, -5), "F1")});
  const ObstacleField floor(only(hub(true)), *standing_blade(0.0), 2.0, 0.0);
  EXPECT_EQ(width_between({buried.get(), &floor}, {wall.get(), nullptr}).narrowest_mm, 0.0);
}

}  // namespace
}  // namespace flank::internal
