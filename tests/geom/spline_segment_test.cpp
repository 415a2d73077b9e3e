#include "flank/geom/spline_segment.h"

#include <gtest/gtest.h>

#include <cmath>

#include "flank/base/random.h"

namespace flank::internal {
namespace {

constexpr double kError = 1e-13;

/// One polynomial of Bernstein form over [0, 1].
SplineRows bezier(std::initializer_list<Eigen::Vector2d> poles) {
  SplineRows rows;
  rows.degree = static_cast<int>(poles.size()) - 1;
  rows.knots.assign(poles.size(), 0.0);
  rows.knots.insert(rows.knots.end(), poles.size(), 1.0);
  rows.poles.resize(2, static_cast<Eigen::Index>(poles.size()));
  Eigen::Index k = 0;
  for (const auto& p : poles) rows.poles.col(k++) = p;
  return rows;
}

TEST(ReadSplineSegment, HalvesOfABezierAreThoseOfDeCasteljau) {
  const SplineRows whole = bezier({{0, 0}, {1, 2}, {3, 3}, {4, 0}});
  const SplineRows low = spline_segment(whole, 0.0, 0.5), high = spline_segment(whole, 0.5, 1.0);
  Eigen::MatrixXd first(2, 4), second(2, 4);
  first << 0, 0.5, 1.25, 2.0, 0, 1.0, 1.75, 1.875;
  second << 2.0, 2.75, 3.5, 4.0, 1.875, 2.0, 1.5, 0.0;
  EXPECT_LT((low.poles - first).norm(), kError);
  EXPECT_LT((high.poles - second).norm(), kError);
  EXPECT_EQ(low.knots, (std::vector<double>{0, 0, 0, 0, 0.5, 0.5, 0.5, 0.5}));
  EXPECT_EQ(high.knots, (std::vector<double>{0.5, 0.5, 0.5, 0.5, 1, 1, 1, 1}));
}

TEST(ReadSplineSegment, TheWholeIsTheSpline) {
  const SplineRows whole = bezier({{0, 0}, {1, 2}, {3, 3}, {4, 0}});
  for (const auto& [a, b] : {std::pair(0.0, 1.0), std::pair(-3.0, 7.0), std::pair(1e-12, 1.0 - 1e-12)}) {
    const SplineRows same = spline_segment(whole, a, b);
    EXPECT_EQ(same.knots, whole.knots) << "ends outside are moved to the ends";
    EXPECT_LT((same.poles - whole.poles).norm(), kError);
  }
}

TEST(ReadSplineSegment, ARationalArcCutInHomogeneousRowsStaysOnItsCircle) {
  const double w = std::sqrt(0.5);
  SplineRows arc;
  arc.degree = 2;
  arc.knots = {0, 0, 0, 1, 1, 1};
  arc.poles.resize(3, 3);
  arc.poles << 1, w, 0, 0, w, 1, 1, w, 1;  // w x, w y, w
  const SplineRows part = spline_segment(arc, 0.2, 0.7);
  ASSERT_EQ(part.poles.cols(), 3);
  for (int i = 0; i <= 10; ++i) {
    const double x = i / 10.0, y = 1.0 - x;
    const Eigen::Vector3d p = y * y * part.poles.col(0) + 2.0 * x * y * part.poles.col(1) + x * x * part.poles.col(2);
    EXPECT_NEAR(std::hypot(p.x(), p.y()) / p.z(), 1.0, kError);
  }
  EXPECT_NEAR(part.poles.col(0).head<2>().norm() / part.poles(2, 0), 1.0, kError) << "it begins on the circle";
}

TEST(ReadSplineSegment, KnotsWithinAreKeptWithTheirMultiplicity) {
  SplineRows rows;
  rows.degree = 3;
  rows.knots = {0, 0, 0, 0, 1, 2, 2, 3, 4, 4, 4, 4};
  Random random(1);
  rows.poles.resize(2, 8);
  for (double& x : rows.poles.reshaped()) x = random.uniform(-1.0, 1.0);
  EXPECT_EQ(spline_segment(rows, 0.5, 3.5).knots,
            (std::vector<double>{0.5, 0.5, 0.5, 0.5, 1, 2, 2, 3, 3.5, 3.5, 3.5, 3.5}));
  EXPECT_EQ(spline_segment(rows, 1.0, 2.0).knots, (std::vector<double>{1, 1, 1, 1, 2, 2, 2, 2}));
}

TEST(ReadSplineSegment, CuttingTwiceIsCuttingOnce) {
  SplineRows rows;
  rows.degree = 4;
  rows.knots = {0, 0, 0, 0, 0, 0.3, 0.5, 0.5, 0.8, 1, 1, 1, 1, 1};
  Random random(2);
  rows.poles.resize(4, 9);
  for (double& x : rows.poles.reshaped()) x = random.uniform(-1.0, 1.0);
  const SplineRows once = spline_segment(rows, 0.35, 0.7),
                   twice = spline_segment(spline_segment(rows, 0.1, 0.9), 0.35, 0.7);
  EXPECT_EQ(once.knots, twice.knots);
  EXPECT_LT((once.poles - twice.poles).norm(), 1e-12);
}

TEST(TwoTurns, RepeatsTheKnotsAPeriodLaterAndSharesThePointOfTheSeam) {
  SplineRows closed = bezier({{1, 0}, {2, 3}, {-2, 3}, {1, 0}});
  const SplineRows twice = two_turns(closed, 1.0);
  EXPECT_EQ(twice.poles.cols(), 7);
  EXPECT_EQ(twice.knots, (std::vector<double>{0, 0, 0, 0, 1, 1, 1, 2, 2, 2, 2}));
  EXPECT_EQ(twice.poles.leftCols(4), closed.poles);
  EXPECT_EQ(twice.poles.rightCols(4), closed.poles);
  const SplineRows second = spline_segment(twice, 1.0, 2.0);
  EXPECT_LT((second.poles - closed.poles).norm(), kError);
}

}  // namespace
}  // namespace flank::internal
