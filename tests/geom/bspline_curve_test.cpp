// B-spline curves against de Boor's algorithm, circles, differences and transformations; the least-squares fit.
#include "flank/bspline_curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flank/base/random.h"
#include "flank/vec.h"

namespace flank::internal {
namespace {

BSplineCurve3 random_curve(std::uint64_t seed, int degree, int count, bool rational) {
  Random random(seed);
  BSplineCurve3 c;
  c.degree = degree;
  c.knots = uniform_knots(degree, count, -1.0, 3.0);
  c.poles.resize(3, count);
  for (int i = 0; i < count; ++i) {
    c.poles.col(i) = Vec3(random.uniform(-9, 9), random.uniform(-9, 9), random.uniform(-9, 9));
    if (rational) c.weights.push_back(random.uniform(0.4, 2.0));
  }
  return c;
}

/// Repeated interpolation of the control points, in homogeneous coordinates.
Vec3 de_boor(const BSplineCurve3& c, double t) {
  const int p = c.degree, span = find_span(p, c.knots, t);
  std::vector<Eigen::Vector4d> d;
  for (int j = 0; j <= p; ++j) {
    const int i = span - p + j;
    const double w = c.weights.empty() ? 1.0 : c.weights[static_cast<std::size_t>(i)];
    d.emplace_back();
    d.back() << w * c.poles.col(i), w;
  }
  for (int r = 1; r <= p; ++r)
    for (int j = p; j >= r; --j) {
      const double low = c.knots[static_cast<std::size_t>(span - p + j)];
      const double high = c.knots[static_cast<std::size_t>(span + 1 + j - r)];
      const double a = (t - low) / (high - low);
      d[static_cast<std::size_t>(j)] =
          ((1.0 - a) * d[static_cast<std::size_t>(j) - 1] + a * d[static_cast<std::size_t>(j)]).eval();
    }
  return d.back().head<3>() / d.back()[3];
}

/// Full circle of radius 4 about (1, 2) as four rational quadratic arcs.
BSplineCurve2 circle() {
  BSplineCurve2 c;
  c.degree = 2;
  c.knots = {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4};
  c.poles.resize(2, 9);
  for (int i = 0; i < 9; ++i) {
    const double angle = i * std::numbers::pi / 4.0, reach = i % 2 == 1 ? std::numbers::sqrt2 : 1.0;
    c.poles.col(i) = Vec2(1.0, 2.0) + 4.0 * reach * Vec2(std::cos(angle), std::sin(angle));
    c.weights.push_back(1.0 / reach);
  }
  return c;
}

TEST(BSplineCurve, EqualsDeBoorsAlgorithm) {
  for (const bool rational : {false, true})
    for (int degree = 1; degree <= 6; ++degree) {
      const BSplineCurve3 c = random_curve(static_cast<std::uint64_t>(degree), degree, degree + 5, rational);
      for (double t = c.first(); t <= c.last(); t += 0.0371) {
        EXPECT_LT((c.value(t) - de_boor(c, t)).norm(), 1e-12) << "degree " << degree << " at " << t;
        EXPECT_LT((c.jet(t).p - c.value(t)).norm(), 1e-12);
      }
    }
}

TEST(BSplineCurve, DerivativesMatchCentralDifferences) {
  constexpr double h = 1e-5;
  for (const bool rational : {false, true})
    for (int degree = 2; degree <= 5; ++degree) {
      const BSplineCurve3 c = random_curve(20 + static_cast<std::uint64_t>(degree), degree, degree + 4, rational);
      for (double t = c.first() + 0.013; t < c.last(); t += 0.0917) {
        const CurveJet<3> a = c.jet(t - h), b = c.jet(t), d = c.jet(t + h);
        EXPECT_LT((b.d1 - (d.p - a.p) / (2 * h)).norm(), 1e-6);
        EXPECT_LT((b.d2 - (d.d1 - a.d1) / (2 * h)).norm(), degree == 2 ? 1e-3 : 1e-5);
      }
    }
}

TEST(BSplineCurve, BeginsAndEndsAtItsOuterControlPoints) {
  for (const bool rational : {false, true}) {
    const BSplineCurve3 c = random_curve(5, 3, 9, rational);
    EXPECT_EQ(c.first(), -1.0);
    EXPECT_EQ(c.last(), 3.0);
    EXPECT_EQ(c.count(), 9);
    EXPECT_LT((c.value(c.first()) - c.poles.col(0)).norm(), 1e-14);
    EXPECT_LT((c.value(c.last()) - c.poles.col(8)).norm(), 1e-13);
    // There it runs along the control polygon.
    EXPECT_LT(c.jet(c.first()).d1.cross(Vec3(c.poles.col(1) - c.poles.col(0))).norm(), 1e-9);
  }
}

TEST(BSplineCurve, ACircleKeepsItsRadiusAndItsCurvature) {
  const BSplineCurve2 c = circle();
  double length = 0.0;
  for (int k = 0; k < 400; ++k) {
    const double t = (k + 0.5) / 100.0;
    const CurveJet<2> jet = c.jet(t);
    const Vec2 r = jet.p - Vec2(1.0, 2.0);
    EXPECT_NEAR(r.norm(), 4.0, 1e-14);
    EXPECT_NEAR(r.dot(jet.d1), 0.0, 1e-12);
    const double speed = jet.d1.norm();
    EXPECT_NEAR((jet.d1[0] * jet.d2[1] - jet.d1[1] * jet.d2[0]) / (speed * speed * speed), 0.25, 1e-12)
        << "to the left";
    length += speed / 100.0;
  }
  EXPECT_NEAR(length, 8.0 * std::numbers::pi, 1e-3);
}

TEST(BSplineCurve, MovesWithItsControlPoints) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const Vec3 shift(4, -5, 6);
  for (const bool rational : {false, true}) {
    const BSplineCurve3 c = random_curve(6, 3, 8, rational);
    BSplineCurve3 moved = c;
    moved.poles = (turn * c.poles).colwise() + shift;
    for (double t = -1.0; t <= 3.0; t += 0.23) {
      const CurveJet<3> a = c.jet(t), b = moved.jet(t);
      EXPECT_LT((b.p - (turn * a.p + shift)).norm(), 1e-12);
      EXPECT_LT((b.d1 - turn * a.d1).norm(), 1e-11);
      EXPECT_LT((b.d2 - turn * a.d2).norm(), 1e-10);
    }
  }
}

TEST(BSplineCurve, EqualWeightsAreNoWeights) {
  const BSplineCurve3 plain = random_curve(7, 3, 8, false);
  BSplineCurve3 weighted = plain;
  weighted.weights.assign(8, 3.7);
  BSplineCurve3 rational = random_curve(8, 3, 8, true), scaled = rational;
  for (double& w : scaled.weights) w *= 0.01;
  for (double t = -1.3; t <= 3.3; t += 0.31) {
    EXPECT_LT((plain.jet(t).d2 - weighted.jet(t).d2).norm(), 1e-11);
    EXPECT_LT((rational.value(t) - scaled.value(t)).norm(), 1e-11);
  }
}

TEST(BSplineCurve, ReversedRunsBackwards) {
  const BSplineCurve3 c = random_curve(9, 4, 10, true);
  BSplineCurve3 back = c;
  back.poles = c.poles.rowwise().reverse().eval();
  std::reverse(back.weights.begin(), back.weights.end());
  std::reverse(back.knots.begin(), back.knots.end());
  for (double& k : back.knots) k = -k;
  for (double t = -1.0; t <= 3.0; t += 0.17) {
    const CurveJet<3> a = c.jet(t), b = back.jet(-t);
    EXPECT_LT((a.p - b.p).norm(), 1e-12);
    EXPECT_LT((a.d1 + b.d1).norm(), 1e-10);
    EXPECT_LT((a.d2 - b.d2).norm(), 1e-9);
  }
}

TEST(BSplineCurve, StaysInTheBoxOfItsActiveControlPoints) {
  const BSplineCurve3 c = random_curve(10, 3, 12, true);
  for (double t = -1.0; t <= 3.0; t += 0.01) {
    const int span = find_span(3, c.knots, t);
    Box3 box;
    for (int j = 0; j <= 3; ++j) box.add(Vec3(c.poles.col(span - 3 + j)));
    EXPECT_LT(box.squared_distance(c.value(t)), 1e-24);
  }
}

struct Data {
  Eigen::Matrix3Xd points;
  std::vector<double> t;
};

Data noisy_helix(int count) {
  Random random(11);
  Data d;
  d.points.resize(3, count);
  for (int k = 0; k < count; ++k) {
    const double t = k / (count - 1.0);
    d.t.push_back(t);
    d.points.col(k) =
        Vec3(5 * std::cos(4 * t), 5 * std::sin(4 * t), 7 * t) + 0.05 * Vec3(random.normal(), random.normal(), 0);
  }
  return d;
}

double squares(const BSplineCurve3& c, const Data& d) {
  double sum = 0.0;
  for (std::size_t k = 0; k < d.t.size(); ++k)
    sum += (c.value(d.t[k]) - d.points.col(static_cast<Eigen::Index>(k))).squaredNorm();
  return sum;
}

TEST(FitCurve, InterpolatesAsManyPointsAsItHasControlPoints) {
  const Data d = noisy_helix(9);
  const BSplineCurve3 c = fit_curve(d.points, d.t, 3, 9);
  EXPECT_LT(std::sqrt(squares(c, d)), 1e-8);
}

TEST(FitCurve, GivesBackTheCurveItsPointsLieOn) {
  BSplineCurve3 truth = random_curve(12, 3, 7, false);
  truth.knots = uniform_knots(3, 7);
  Data d;
  d.points.resize(3, 60);
  for (int k = 0; k < 60; ++k) {
    d.t.push_back(k / 59.0);
    d.points.col(k) = truth.value(d.t.back());
  }
  EXPECT_LT((fit_curve(d.points, d.t, 3, 7).poles - truth.poles).cwiseAbs().maxCoeff(), 1e-8);
}

TEST(FitCurve, NoOtherCurveIsNearer) {
  const Data d = noisy_helix(80);
  const BSplineCurve3 best = fit_curve(d.points, d.t, 3, 10);
  const double least = squares(best, d);
  for (int i = 0; i < 10; ++i)
    for (int axis = 0; axis < 3; ++axis)
      for (const double step : {1e-3, -1e-3}) {
        BSplineCurve3 other = best;
        other.poles(axis, i) += step;
        EXPECT_GT(squares(other, d), least) << "control point " << i;
      }
}

TEST(FitCurve, MovesWithItsPoints) {
  const Data d = noisy_helix(40);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.1, Vec3(3, 1, -2).normalized()).toRotationMatrix();
  const Vec3 shift(100, -20, 3);
  const BSplineCurve3 a = fit_curve(d.points, d.t, 3, 9);
  const BSplineCurve3 b = fit_curve((turn * d.points).colwise() + shift, d.t, 3, 9);
  EXPECT_LT((b.poles - ((turn * a.poles).colwise() + shift)).cwiseAbs().maxCoeff(), 1e-8);
}

TEST(FitCurve, AGapInThePointsIsBridgedEvenly) {
  Data d;
  d.points.resize(3, 40);
  for (int k = 0; k < 40; ++k) {  // a straight line without its middle third
    const double t = k < 20 ? k / 60.0 : (k + 21) / 60.0;
    d.t.push_back(t);
    d.points.col(k) = Vec3(30.0 * t, 1.0 - t, 2.0);
  }
  const BSplineCurve3 c = fit_curve(d.points, d.t, 3, 24);
  ASSERT_TRUE(c.poles.allFinite());
  for (double t = 0.34; t < 0.66; t += 0.02) EXPECT_LT((c.value(t) - Vec3(30.0 * t, 1.0 - t, 2.0)).norm(), 0.05) << t;
}

}  // namespace
}  // namespace flank::internal
