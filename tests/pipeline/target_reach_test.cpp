// How finely the faces around a target are cut for the ball that says what is reachable.
#include "flank/pipeline/folder/target_reach.h"

#include <gtest/gtest.h>

namespace flank::internal {
namespace {

TEST(ReachFineness, IsAQuarterOfTheToleranceForPartsOfAHandsSize) {
  const ReachFineness fine = reach_fineness(0.02, 3.0);
  EXPECT_DOUBLE_EQ(fine.fine_mm, 0.005);
  EXPECT_DOUBLE_EQ(fine.cell_mm, 1.0);
  EXPECT_DOUBLE_EQ(reach_fineness(1e-5, 3.0).fine_mm, 0.001);
  EXPECT_DOUBLE_EQ(reach_fineness(0.5, 3.0).fine_mm, 0.01);
}

TEST(ReachFineness, ShrinksWithTheBallOfAPartOfAMillimetre) {
  // A thousandth of a millimetre is all of the tolerance there, and a cell of one millimetre all of the part.
  const ReachFineness tiny = reach_fineness(0.001, 0.04);
  EXPECT_DOUBLE_EQ(tiny.fine_mm, 0.00025);
  EXPECT_DOUBLE_EQ(tiny.cell_mm, 0.04);
  EXPECT_DOUBLE_EQ(reach_fineness(1e-6, 0.04).fine_mm, 4e-5);
  // But not on a hub of a metre beside it.
  EXPECT_DOUBLE_EQ(tiny.cell_on(1.0), 0.04);
  EXPECT_DOUBLE_EQ(tiny.cell_on(1000.0), 1.0);
  EXPECT_DOUBLE_EQ(reach_fineness(1e-6, 0.04).fine_on(1000.0), 0.001);
  EXPECT_DOUBLE_EQ(reach_fineness(0.02, 3.0).cell_on(100.0), 1.0);
}

TEST(ReachFineness, GrowsWithTheBallSoThatAShipTakesNoMoreTrianglesThanABlade) {
  const ReachFineness blade = reach_fineness(0.3, 10.0), ship = reach_fineness(300.0, 10000.0);
  EXPECT_NEAR(ship.fine_mm, 1000.0 * blade.fine_mm, 1e-9);
  EXPECT_NEAR(ship.coarse_mm, 1000.0 * blade.coarse_mm, 1e-9);
  EXPECT_NEAR(ship.cell_mm, 1000.0 * blade.cell_mm, 1e-9);
  // Where more is asked for, it is as fine as that.
  EXPECT_DOUBLE_EQ(reach_fineness(0.02, 10000.0).fine_mm, 0.005);
}

}  // namespace
}  // namespace flank::internal
