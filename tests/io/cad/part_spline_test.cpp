#include <gtest/gtest.h>

#include "flank/base/random.h"
#include "flank/bspline_curve.h"
#include "flank/geom/spline_segment.h"

namespace flank::internal {
namespace {

constexpr double kSegmentError = 1e-12;

BSplineCurve2 curve_of(const SplineRows& rows) {
  BSplineCurve2 c;
  c.degree = rows.degree;
  c.knots = rows.knots;
  c.poles = rows.poles;
  return c;
}

SplineRows random_rows(int degree, std::vector<double> knots, std::uint64_t seed) {
  Random random(seed);
  SplineRows rows{degree, std::move(knots), {}};
  rows.poles.resize(2, static_cast<Eigen::Index>(rows.knots.size()) - degree - 1);
  for (double& x : rows.poles.reshaped()) x = random.uniform(-1.0, 1.0);
  return rows;
}

void expect_same(const SplineRows& whole, const SplineRows& part, double a, double b) {
  EXPECT_EQ(part.knots.size(), static_cast<std::size_t>(part.poles.cols() + part.degree + 1));
  for (int i = 0; i <= part.degree; ++i) {
    EXPECT_EQ(part.knots[static_cast<std::size_t>(i)], a) << "clamped";
    EXPECT_EQ(part.knots[part.knots.size() - 1 - static_cast<std::size_t>(i)], b) << "clamped";
  }
  const BSplineCurve2 f = curve_of(whole), g = curve_of(part);
  for (int i = 0; i <= 50; ++i) {
    const double t = a + (b - a) * i / 50;
    EXPECT_LT((f.value(t) - g.value(t)).norm(), kSegmentError) << t;
  }
}

TEST(SplineSegment, IsTheSameFunction) {
  for (int degree = 1; degree <= 5; ++degree) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      Random random(1000 + seed);
      const SplineRows whole = random_rows(degree, uniform_knots(degree, degree + 6), seed);
      const double a = random.uniform(0.0, 0.5), b = random.uniform(0.5, 1.0);
      expect_same(whole, spline_segment(whole, a, b), a, b);
    }
  }
}

TEST(SplineSegment, AtKnotsOfAnyMultiplicity) {
  const SplineRows whole = random_rows(3, {0, 0, 0, 0, 1, 2, 2, 3, 3, 3, 4, 4, 4, 4}, 5);
  for (const double a : {0.0, 1.0, 2.0, 2.5})
    for (const double b : {3.0, 3.5, 4.0}) expect_same(whole, spline_segment(whole, a, b), a, b);
}

TEST(SplineSegment, ClampsKnotsThatAreNot) {
  const SplineRows whole = random_rows(3, {-3, -2, -1, 0, 1, 2, 3, 4, 5, 6, 7}, 6);
  expect_same(whole, spline_segment(whole, 0.0, 4.0), 0.0, 4.0);
  expect_same(whole, spline_segment(whole, 0.3, 3.2), 0.3, 3.2);
}

TEST(SplineSegment, EndsBesideAKnotAreTheKnot) {
  const SplineRows whole = random_rows(2, {0, 0, 0, 1, 2, 2, 2}, 7);
  const SplineRows part = spline_segment(whole, 1.0 + 1e-12, 5.0);
  EXPECT_EQ(part.knots, (std::vector<double>{1, 1, 1, 2, 2, 2}));
}

TEST(SplineSegment, PiecesAcrossTheSeam) {
  SplineRows whole = random_rows(3, uniform_knots(3, 9, 0.0, 2.0), 8);
  whole.poles.col(8) = whole.poles.col(0);
  const SplineRows part = spline_segment(two_turns(whole, 2.0), 1.3, 2.9);
  const BSplineCurve2 f = curve_of(whole), g = curve_of(part);
  for (int i = 0; i <= 40; ++i) {
    const double t = 1.3 + 1.6 * i / 40;
    EXPECT_LT((f.value(t > 2.0 ? t - 2.0 : t) - g.value(t)).norm(), kSegmentError) << t;
  }
}

}  // namespace
}  // namespace flank::internal
