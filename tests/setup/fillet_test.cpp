#include "flank/setup/fillet.h"

#include <gtest/gtest.h>

#include "setup/corner_part.h"

namespace flank::internal {
namespace {

using testing::corner;

TEST(TightestFillet, IsThatOfAHollowCorner) {
  const Part part = corner(true);
  ASSERT_TRUE(tightest_fillet(part, {0}, 10.0).has_value());
  EXPECT_NEAR(*tightest_fillet(part, {0}, 10.0), 5.0, 0.02);
  EXPECT_NEAR(tightest_fillet(part, {2}, 10.0).value_or(0.0), 5.0, 0.02);
}

TEST(TightestFillet, IsBelowTheLimit) { EXPECT_FALSE(tightest_fillet(corner(true), {0}, 4.9).has_value()); }

TEST(TightestFillet, ARoundedEdgeIsNone) { EXPECT_FALSE(tightest_fillet(corner(false), {0}, 10.0).has_value()); }

TEST(TightestFillet, IsNoFaceOfTheTarget) { EXPECT_FALSE(tightest_fillet(corner(true), {0, 1, 2}, 10.0).has_value()); }

TEST(TightestFillet, OfSheetsAndSharpEdgesIsNone) {
  Part part = corner(true);
  part.faces[1].of_solid = false;
  EXPECT_FALSE(tightest_fillet(part, {0}, 10.0).has_value());
  part = corner(true);
  part.left_out[1] = "why";
  EXPECT_FALSE(tightest_fillet(part, {0}, 10.0).has_value());
}

TEST(TightestFillet, TouchingAlongAShortStretchIsNone) {
  // The floor is five times as wide as the corner is long: that is the round of a hole's rim, or a corner patch.
  Part part = corner(true);
  const auto wide = [](double f) { return Vec3(-600.0 + 620.0 * f, 0.0, 0.0); };
  Face floor = testing::drawn_skin(wide, 30.0, 0.0, 8);
  floor.id = "F1";
  floor.of_solid = true;
  floor.solid = 0;
  floor.reversed = part.faces[0].reversed;
  part.faces[0] = floor;
  EXPECT_FALSE(tightest_fillet(part, {0}, 10.0).has_value());
}

}  // namespace
}  // namespace flank::internal
