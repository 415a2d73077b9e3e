// A flank that is lengthened keeps its profile, and is lengthened no more than is needed.
#include "flank/fit/lengthen.h"

#include <gtest/gtest.h>

#include "seed/exact_targets.h"

namespace flank::internal {
namespace {

RadialFunction bulged() {
  return RadialFunction::spline(40.0, (Eigen::VectorXd(8) << 2, 2.3, 2.9, 3.4, 3.5, 3.2, 3.4, 3.6).finished());
}

TEST(Lengthen, TheProfileStays) {
  const RadialFunction before = bulged(), after = lengthened(before, 5.0);
  EXPECT_EQ(after.axis_length(), 45.0);
  for (int j = 0; j <= 100; ++j) EXPECT_NEAR(after.at(0.39 * j).r, before.at(0.39 * j).r, 2e-3) << j;
  EXPECT_NEAR(after.at(45.0).r, before.at(40.0).r + 2.5 * before.at(40.0).d1, 2e-3);
  EXPECT_NEAR(after.at(45.0).d1, 0.0, 2e-2);
}

TEST(Lengthen, TheProfileStaysWhereTheTipGrowsToo) {
  constexpr double kClose = 5e-3;  // the slope is steeper at this end, and ends within 3 mm
  const RadialFunction before = bulged(), after = lengthened(before, 5.0, 3.0);
  EXPECT_EQ(after.axis_length(), 48.0);
  for (int j = 0; j <= 100; ++j) EXPECT_NEAR(after.at(3.0 + 0.4 * j).r, before.at(0.4 * j).r, kClose) << j;
  EXPECT_NEAR(after.at(0.0).r, before.at(0.0).r - 1.5 * before.at(0.0).d1, kClose);
  EXPECT_NEAR(after.at(0.0).d1, 0.0, 2e-2);
}

TEST(Lengthen, StopsAtTheFirstLengthThatIsClear) {
  FlankFitResult fit;
  fit.tool = bulged();
  fit.motions = {testing::straight_motion(40.0)};
  const auto longer_than = [](double length) {
    return [length](const FlankFitResult& result) {
      EXPECT_EQ(result.tool.axis_length(), result.motions.front().axis_length);
      return result.tool.axis_length() > length;
    };
  };
  FlankFitResult clear = fit;
  EXPECT_EQ(lengthen_until_clear(clear, 1.0, longer_than(30.0)), 0.0);
  EXPECT_EQ(clear.tool.axis_length(), 40.0);
  FlankFitResult lifted = fit;
  EXPECT_EQ(lengthen_until_clear(lifted, 1.0, longer_than(42.5)), 4.0);
  EXPECT_EQ(lifted.motions.front().axis_length, 44.0);
  FlankFitResult hopeless = fit;
  EXPECT_EQ(lengthen_until_clear(hopeless, 1.0, longer_than(99.0)), 0.0);
  EXPECT_EQ(hopeless.tool.axis_length(), 40.0);
}

}  // namespace
}  // namespace flank::internal
