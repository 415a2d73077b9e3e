// Crests of ridges: where the lines on both sides of a few times meet.
#include "flank/trochoid/engagement/ridge.h"

#include <gtest/gtest.h>

#include <cmath>

namespace flank::internal {
namespace {

RingTimes tent(double first, double step, double top, double at) {
  RingTimes out{};
  for (std::size_t k = 0; k < kRidgeTimes; ++k) {
    const double t = first + step * static_cast<double>(k);
    out[k] = top - (t < at ? 3.0 * (at - t) : 5.0 * (t - at));
  }
  return out;
}

TEST(CrestOf, IsWhereTheLinesMeet) {
  for (const double at : {0.2213, 0.241, 0.2505, 0.2716}) {
    const Crest crest = crest_of(tent(0.2, 0.015, 1.0, at), 0.2, 0.015);
    EXPECT_NEAR(crest.t, at, 1e-12);
    EXPECT_NEAR(crest.angle_rad, 1.0, 1e-12);
  }
}

TEST(CrestOf, IsTheLargestWhereNoLinesMeet) {
  const Crest rising = crest_of({1, 2, 3, 4, 5, 6, 7}, 0.2, 0.01);
  EXPECT_NEAR(rising.t, 0.26, 1e-12);
  EXPECT_EQ(rising.angle_rad, 7.0);
  EXPECT_EQ(crest_of(RingTimes{}, 0.2, 0.01).angle_rad, 0.0);
}

TEST(CrestOf, MayLieBesideTheLastTimeOfAMotion) {
  const Crest crest = crest_of({1, 2, 3, 4, 5, 6, 3}, 0.94, 0.01);
  EXPECT_GT(crest.angle_rad, 6.0);
  EXPECT_GT(crest.t, 0.99);
  EXPECT_LT(crest.t, 1.0);
}

TEST(Ridge, TopsAreItsHighestCrests) {
  const Ridge ridge{{0.2, 0.26, 0.0, 8.0}, {{2.0, 0.21}, {1.0, 0.22}, {3.0, 0.23}, {2.5, 0.24}, {0.0, 0.2}}};
  EXPECT_EQ(ridge.tops(), (std::vector<std::size_t>{2, 0}));
  EXPECT_NEAR(ridge.s_of(2), 4.0, 1e-12);
  const RidgeWindow around = ridge.around(2);
  EXPECT_NEAR(around.s_low, 2.0, 1e-12);
  EXPECT_NEAR(around.s_high, 6.0, 1e-12);
  EXPECT_LT(around.t_low, 0.22);
  EXPECT_GT(around.t_high, 0.24);
  EXPECT_LT(ridge.around(0).s_low, 0.0) << "as far as a ring that is not there";
}

}  // namespace
}  // namespace flank::internal
