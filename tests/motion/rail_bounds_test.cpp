#include "flank/motion/rail_bounds.h"

#include <gtest/gtest.h>

#include "motion/sample_motions.h"

namespace flank::internal {
namespace {

using testing::random_motion;

TEST(Derivative, MatchesTheJet) {
  const BSplineCurve3 curve = random_motion(7).tip;
  const BSplineCurve3 d1 = derivative(curve), d2 = derivative(d1);
  for (int i = 0; i <= 50; ++i) {
    const CurveJet<3> jet = curve.jet(i / 50.0);
    EXPECT_LT((d1.value(i / 50.0) - jet.d1).norm(), 1e-11);
    EXPECT_LT((d2.value(i / 50.0) - jet.d2).norm(), 1e-9);
  }
}

TEST(RailBounds, HoldOverEveryInterval) {
  Random random(11);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const BSplineCurve3 curve = random_motion(seed).tip;
    const double t0 = random.uniform(0.0, 0.9), t1 = random.uniform(t0, 1.0);
    const Vec3 direction = Vec3(random.normal(), random.normal(), random.normal()).normalized();
    double largest = 0.0, smallest = 1e300;
    for (int i = 0; i <= 1000; ++i) {
      const Vec3 p = curve.value(t0 + (t1 - t0) * i / 1000.0);
      largest = std::max(largest, p.norm());
      smallest = std::min(smallest, p.dot(direction));
    }
    EXPECT_LE(largest, largest_norm(curve, t0, t1) * (1.0 + 1e-14));
    EXPECT_GE(smallest, smallest_component(curve, direction, t0, t1) - 1e-12);
  }
}

TEST(RailBounds, AreTightOnShortIntervals) {
  const BSplineCurve3 curve = random_motion(2).tip;
  for (const double t : {0.0, 0.31, 0.66, 0.99}) {
    const double bound = largest_norm(curve, t, t + 0.01);
    EXPECT_LT(bound, 1.01 * std::max(curve.value(t).norm(), curve.value(t + 0.01).norm()) + 1e-3);
  }
}

TEST(RailBounds, AreExactForLinearPieces) {
  const BSplineCurve3 d2 = derivative(derivative(random_motion(5).tip));
  double largest = 0.0;
  for (const double knot : d2.knots) largest = std::max(largest, d2.value(knot).norm());
  EXPECT_NEAR(largest_norm(d2, 0.0, 1.0), largest, 1e-12 * largest);
}

}  // namespace
}  // namespace flank::internal
