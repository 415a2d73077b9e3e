// Order and direction of strips.
#include "flank/strip/strip_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "cover/cover_targets.h"
#include "flank/base/random.h"

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

/// Straight strips between random places.
std::vector<RuledMotion> scattered(int count, Random& random) {
  std::vector<RuledMotion> motions;
  for (int k = 0; k < count; ++k) {
    const Vec3 a(random.uniform(0, 100), random.uniform(0, 100), 0.0);
    const Vec3 b(random.uniform(0, 100), random.uniform(0, 100), 0.0);
    RuledMotion motion = testing::straight_motion(10.0);
    for (int i = 0; i < 4; ++i) motion.tip.poles.col(i) = a + i / 3.0 * (b - a);
    motions.push_back(motion);
  }
  return motions;
}

/// The least link length over all orders and directions.
double shortest(const std::vector<RuledMotion>& motions) {
  std::vector<std::size_t> order(motions.size());
  std::iota(order.begin(), order.end(), 0u);
  double least = 1e300;
  do {
    for (unsigned turned = 0; turned < 1u << motions.size(); ++turned) {
      double sum = 0.0;
      const auto end = [&](std::size_t k, bool last) {
        return motions[k].pose(last != ((turned >> k & 1u) != 0) ? 1.0 : 0.0).tip;
      };
      for (std::size_t i = 0; i + 1 < order.size(); ++i) sum += (end(order[i + 1], false) - end(order[i], true)).norm();
      least = std::min(least, sum);
    }
  } while (std::next_permutation(order.begin(), order.end()));
  return least;
}

TEST(Order, IsTheShortestOfAllForAFewStrips) {
  Random random(61);
  for (int trial = 0; trial < 20; ++trial) {
    const std::vector<RuledMotion> motions = scattered(4, random);
    EXPECT_NEAR(link_length(ordered(motions)), shortest(motions), 1e-6) << trial;
  }
}

TEST(Order, IsLittleLongerThanTheShortestForSome) {
  Random random(62);
  for (int trial = 0; trial < 4; ++trial) {
    const std::vector<RuledMotion> motions = scattered(6, random);
    const double found = link_length(ordered(motions)), least = shortest(motions);
    EXPECT_GE(found, least - 1e-6);
    EXPECT_LE(found, 1.1 * least) << trial;
  }
}

TEST(Order, EveryStripOnceAndTurnedAsItSays) {
  Random random(63);
  const std::vector<RuledMotion> motions = scattered(9, random);
  const StripOrder order = strip_order(motions);
  const std::vector<RuledMotion> run = ordered(motions);
  std::vector<std::size_t> sorted = order.index;
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t k = 0; k < 9; ++k) EXPECT_EQ(sorted[k], k);
  for (std::size_t i = 0; i < 9; ++i) {
    const RuledMotion& given = motions[order.index[i]];
    EXPECT_NEAR((run[i].pose(0.0).tip - given.pose(order.turned[i] != 0 ? 1.0 : 0.0).tip).norm(), 0.0, 1e-12);
  }
  EXPECT_LE(link_length(run), link_length(motions));
}

TEST(Order, ALinkIsTheMeanWayOfBothEnds) {
  RuledMotion from = row(0.0, true), to = row(0.0, false);
  // From (60, 0, 0) to (60, 0, 0), the axis turned about its tip by a right angle.
  to.direction.poles.colwise() = Vec3(0.0, 1.0, 0.0);
  EXPECT_NEAR(link_length(from, to), 0.5 * 10.0 * std::sqrt(2.0), 1e-9);
  EXPECT_EQ(link_length(std::vector<RuledMotion>{from}), 0.0);
}

}  // namespace
}  // namespace flank::internal
