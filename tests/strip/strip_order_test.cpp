// Order and direction of strips.
#include "flank/strip/strip_order.h"

#include <gtest/gtest.h>

#include "cover/cover_targets.h"

namespace flank::internal {
namespace {

/// A strip along x at height y, to the right or to the left.
RuledMotion row(double y, bool to_the_right) {
  RuledMotion motion = testing::straight_motion(10.0);
  for (int i = 0; i < 4; ++i) motion.tip.poles.col(i) = Vec3(20.0 * (to_the_right ? i : 3 - i), y, 0.0);
  return motion;
}

TEST(Order, RunsRowsToAndFro) {
  const std::vector<RuledMotion> rows = {row(20.0, true), row(0.0, true), row(30.0, true), row(10.0, true)};
  const std::vector<RuledMotion> best = ordered(rows);
  ASSERT_EQ(best.size(), rows.size());
  EXPECT_NEAR(link_length(best), 30.0, 1e-9);
  EXPECT_GT(link_length(rows), 150.0);
}

TEST(Order, ReversedIsTheSameEnvelopeTheOtherWay) {
  const RuledMotion motion = testing::bent_motion(30.0), back = reversed(motion);
  for (const double t : {0.0, 0.2, 0.5, 0.9, 1.0}) {
    EXPECT_LT((back.pose(t).tip - motion.pose(1.0 - t).tip).norm(), 1e-12);
    EXPECT_LT((back.pose(t).axis - motion.pose(1.0 - t).axis).norm(), 1e-12);
  }
}

TEST(Order, TakesOneAndNone) {
  EXPECT_TRUE(ordered({}).empty());
  EXPECT_EQ(ordered({row(0.0, true)}).size(), 1u);
}

}  // namespace
}  // namespace flank::internal
