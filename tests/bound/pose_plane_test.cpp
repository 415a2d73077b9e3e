#include "flank/bound/contact/pose_plane.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "flank/base/random.h"

namespace flank::internal {
namespace {

struct Limits {
  double sigma, low, high;
  [[nodiscard]] bool hold(const Vec2& move, double spare) const {
    const double rise = move.x() + move.y() * sigma;
    return rise >= low - spare && rise <= high + spare;
  }
};

/// What fulfils all limits stays: its rises are within what the polygon says.
TEST(PosePlane, LosesNoMoveThatIsPossible) {
  Random random(3);
  for (int trial = 0; trial < 200; ++trial) {
    const Vec2 move(random.uniform(-1, 1), random.uniform(-1, 1));
    PosePlane plane(1.0, 1.0);
    for (int k = 0; k < 120; ++k) {
      const double sigma = random.uniform(-3, 3), rise = move.x() + move.y() * sigma;
      plane.cut(sigma, rise - random.uniform(0.0, 0.4), rise + random.uniform(0.0, 0.4));
    }
    ASSERT_FALSE(plane.empty());
    for (const double sigma : {-3.0, 0.0, 2.0})
      EXPECT_GE(plane.most_rise(sigma), std::abs(move.x() + move.y() * sigma) - 1e-12);
    EXPECT_GE(plane.most_slope(), std::abs(move.y()) - 1e-12);
  }
}

TEST(PosePlane, HoldsOnlyWhatFulfilsAllLimits) {
  Random random(4);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Limits> limits;
    PosePlane plane(1.0, 1.0);
    for (int k = 0; k < 6; ++k) {
      const double low = random.uniform(-1.0, 0.5);
      limits.push_back({random.uniform(-3, 3), low, low + random.uniform(0.1, 1.0)});
      plane.cut(limits.back().sigma, limits.back().low, limits.back().high);
    }
    if (plane.empty()) continue;
    for (const Limits& limit : limits) EXPECT_TRUE(limit.hold(plane.middle(), 1e-12));
  }
}

TEST(PosePlane, OfTwoHoldsWhatBothHave) {
  Random random(5);
  int common = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const Vec2 move(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5));
    PosePlane a(1.0, 1.0), b(1.0, 1.0);
    for (int k = 0; k < 4; ++k) {
      const double s = random.uniform(-3, 3), rise = move.x() + move.y() * s;
      a.cut(s, rise - 0.1, rise + 0.2);
      b.cut(-s, move.x() - move.y() * s - 0.2, move.x() - move.y() * s + 0.1);
    }
    a.cut(b);
    common += a.empty() ? 0 : 1;
    EXPECT_GE(a.most_slope(), std::abs(move.y()) - 1e-9);
  }
  EXPECT_EQ(common, 300);
}

TEST(PosePlane, OfTwoThatHaveNothingInCommonIsEmpty) {
  PosePlane a(1.0, 1.0), b(1.0, 1.0);
  a.cut(2.0, 0.5, 1.0);
  b.cut(2.0, -1.0, 0.4);
  a.cut(b);
  EXPECT_TRUE(a.empty());
  EXPECT_EQ(a.most_rise(1.0), 0.0);
}

TEST(PosePlane, IsNotCutByWhatIsNotKnown) {
  PosePlane plane(1.0, 1.0);
  const double none = std::numeric_limits<double>::quiet_NaN(), far = std::numeric_limits<double>::infinity();
  plane.cut(1.0, none, none);
  plane.cut(1.0, -far, far);
  EXPECT_EQ(plane.most_rise(1.0), 2.0);
}

}  // namespace
}  // namespace flank::internal
