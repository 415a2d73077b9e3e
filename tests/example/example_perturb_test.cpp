#include <gtest/gtest.h>

#include <cmath>

#include "flank/example.h"
#include "flank/example/example_motions.h"
#include "flank/example/example_perturb.h"

namespace flank::internal {
namespace {

TEST(Perturb, HasTheSizeAskedForAndStaysSmooth) {
  Random random(5);
  for (const double relative : {1e-2, 1e-4}) {
    for (int k = 1; k <= kExampleMotions; ++k) {
      const RuledMotion exact = example_motion(k, 40.0);
      const RuledMotion moved = perturb(exact, relative, 90.0, random);
      double largest = 0.0, bend = 0.0;
      for (int i = 0; i <= 300; ++i) {
        const double t = i / 300.0;
        const Pose a = exact.pose(t), b = moved.pose(t);
        largest = std::max({largest, (a.tip - b.tip).norm(), (a.at(40.0) - b.at(40.0)).norm()});
        bend = std::max(bend, (exact.tip.jet(t).d2 - moved.tip.jet(t).d2).norm());
      }
      EXPECT_NEAR(largest, relative * 90.0, 0.02 * relative * 90.0);
      EXPECT_LT(bend, 80.0 * relative * 90.0);  // at most about one period: (2 pi)^2 times the size
    }
  }
}

TEST(Perturb, DependsOnTheSeedOnly) {
  const RuledMotion exact = example_motion(1, 40.0);
  Random a(1), b(1), c(2);
  const RuledMotion first = perturb(exact, 1e-2, 90.0, a);
  EXPECT_EQ(first.tip.poles, perturb(exact, 1e-2, 90.0, b).tip.poles);
  EXPECT_NE(first.tip.poles, perturb(exact, 1e-2, 90.0, c).tip.poles);
}

TEST(Perturb, OfNothingIsTheSameMotion) {
  Random random(3);
  const RuledMotion exact = example_motion(3, 40.0);
  const RuledMotion same = perturb(exact, 0.0, 90.0, random);
  // Not exactly: the direction is made unit before it is fitted, which a cubic cannot hold.
  for (const double t : {0.0, 0.3, 0.8, 1.0}) EXPECT_LT((exact.pose(t).at(40.0) - same.pose(t).at(40.0)).norm(), 1e-3);
}

}  // namespace
}  // namespace flank::internal
