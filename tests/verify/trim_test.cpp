#include "flank/verify/trim.h"

#include <gtest/gtest.h>

#include <cmath>

#include "flank/base/random.h"
#include "verify/faces.h"

namespace flank::internal::verify {
namespace {

constexpr double kToleranceUv = 1e-4;

bool inside(const Trim& trim, double u, double v) { return trim.inside(trim.crossings(v), u); }

BSplineCurve2 reversed(BSplineCurve2 c) {
  for (double& k : c.knots) k = -k;
  std::reverse(c.knots.begin(), c.knots.end());
  c.poles = c.poles.rowwise().reverse().eval();
  std::reverse(c.weights.begin(), c.weights.end());
  return c;
}

TEST(VerifyTrim, WithoutLoopsEverythingIsInside) {
  const Trim trim({}, kToleranceUv, kToleranceUv);
  EXPECT_TRUE(trim.everything());
  EXPECT_TRUE(inside(trim, 1e9, -1e9));
}

TEST(VerifyTrim, ACirclesCrossingsAreThoseOfTheCircle) {
  const Trim trim({test::circle({0.5, 0.4}, 0.3)}, kToleranceUv, kToleranceUv);
  EXPECT_FALSE(trim.everything());
  for (int i = 1; i < 60; ++i) {
    const double v = 0.1 + 0.6 * i / 60.0, half = std::sqrt(0.09 - (v - 0.4) * (v - 0.4));
    const std::vector<double> at = trim.crossings(v);
    ASSERT_EQ(at.size(), 2u) << v;
    // A chord within the tolerance of the arc, seen along u.
    const double tolerance = 2.0 * kToleranceUv * (1.0 + 0.3 / half);
    EXPECT_NEAR(at[0], 0.5 - half, tolerance);
    EXPECT_NEAR(at[1], 0.5 + half, tolerance);
  }
  EXPECT_TRUE(trim.crossings(0.05).empty());
  EXPECT_TRUE(trim.crossings(0.75).empty());
  EXPECT_NEAR((trim.low() - Vec2(0.2, 0.1)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((trim.high() - Vec2(0.8, 0.7)).norm(), 0.0, 1e-12);
}

TEST(VerifyTrim, HolesAndIslandsInThemByTheEvenOddRule) {
  const std::vector<TrimLoop> loops{test::polygon({{0, 0}, {1, 0}, {1, 1}, {0, 1}}), test::circle({0.5, 0.5}, 0.4),
                                    test::circle({0.5, 0.5}, 0.2)};
  const Trim trim(loops, kToleranceUv, kToleranceUv);
  Random random(1);
  for (int i = 0; i < 4000; ++i) {
    const double u = random.uniform(-0.2, 1.2), v = random.uniform(-0.2, 1.2), r = std::hypot(u - 0.5, v - 0.5);
    if (std::abs(r - 0.4) < 3e-4 || std::abs(r - 0.2) < 3e-4) continue;
    const bool square = u > 0.0 && u < 1.0 && v > 0.0 && v < 1.0;
    ASSERT_EQ(inside(trim, u, v), square && (r > 0.4 || r < 0.2)) << u << ' ' << v;
  }
}

TEST(VerifyTrim, TheWayRoundALoopDoesNotMatter) {
  const TrimLoop loop = test::circle({0.5, 0.5}, 0.3);
  TrimLoop back;
  for (auto edge = loop.edges.rbegin(); edge != loop.edges.rend(); ++edge) back.edges.push_back(reversed(*edge));
  const Trim forward({loop}, kToleranceUv, kToleranceUv), backward({back}, kToleranceUv, kToleranceUv);
  for (int i = 0; i < 50; ++i) {
    const double v = 0.21 + 0.58 * i / 50.0;
    const std::vector<double> a = forward.crossings(v), b = backward.crossings(v);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < a.size(); ++k) ASSERT_NEAR(a[k], b[k], 1e-12);
  }
}

TEST(VerifyTrim, EveryLineCrossesALoopAnEvenNumberOfTimes) {
  // Lines through corners and along edges are the ones that go wrong.
  const std::vector<Vec2> star{{0, 0}, {1, 0.5}, {2, 0}, {1.5, 1}, {2, 2}, {1, 1.5}, {0, 2}, {0.5, 1}};
  const Trim trim({test::polygon(star), test::polygon({{0.9, 0.9}, {1.1, 0.9}, {1.1, 1.1}, {0.9, 1.1}})}, kToleranceUv,
                  kToleranceUv);
  for (const double v : {0.0, 0.5, 0.9, 1.0, 1.1, 1.5, 2.0, 0.25, 1.75}) {
    const std::vector<double> at = trim.crossings(v);
    EXPECT_EQ(at.size() % 2, 0u) << v;
    EXPECT_TRUE(std::is_sorted(at.begin(), at.end()));
  }
  EXPECT_TRUE(inside(trim, 0.7, 1.0));
  EXPECT_FALSE(inside(trim, 1.0, 1.0)) << "in the hole";
  EXPECT_FALSE(inside(trim, 0.2, 1.0)) << "between two points of the star";
}

TEST(VerifyTrim, GapsBetweenEdgesAreClosedByChords) {
  TrimLoop loop = test::polygon({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  for (BSplineCurve2& edge : loop.edges) {
    const Vec2 shorter = 0.01 * (edge.poles.col(1) - edge.poles.col(0));
    edge.poles.col(0) += shorter;
    edge.poles.col(1) -= shorter;
  }
  const Trim trim({loop}, kToleranceUv, kToleranceUv);
  for (const double v : {0.001, 0.005, 0.5, 0.995}) EXPECT_EQ(trim.crossings(v).size(), 2u) << v;
  EXPECT_NEAR(trim.crossings(0.005)[0], 0.005, 1e-12) << "across the corner that is missing";
}

TEST(VerifyTrim, ABendBetweenTheFirstSamplesIsNotMissed) {
  // One polynomial edge that swings to both sides and comes back to the line: its middle lies on the chord.
  BSplineCurve2 swing;
  swing.degree = 3;
  swing.knots = {0, 0, 0, 0, 1, 1, 1, 1};
  swing.poles.resize(2, 4);
  swing.poles << 0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0, 0.0, 0.6, -0.6, 0.0;
  TrimLoop loop;
  loop.edges = {swing};
  for (const auto& [from, to] :
       {std::pair(Vec2(1, 0), Vec2(1, 1)), std::pair(Vec2(1, 1), Vec2(0, 1)), std::pair(Vec2(0, 1), Vec2(0, 0))}) {
    BSplineCurve2 edge;
    edge.degree = 1;
    edge.knots = {0, 0, 1, 1};
    edge.poles.resize(2, 2);
    edge.poles.col(0) = from, edge.poles.col(1) = to;
    loop.edges.push_back(edge);
  }
  const Trim trim({loop}, kToleranceUv, kToleranceUv);
  for (int i = 1; i < 100; ++i) {
    const double u = i / 100.0, v = 1.8 * u * (1 - u) * (1 - u) - 1.8 * u * u * (1 - u);
    EXPECT_TRUE(inside(trim, u, v + 5e-4)) << u;
    EXPECT_FALSE(inside(trim, u, v - 5e-4)) << u;
  }
}

TEST(VerifyTrim, AFinerToleranceComesNearerToTheCurve) {
  double before = 1e300;
  for (const double tolerance : {1e-2, 1e-3, 1e-5}) {
    const Trim trim({test::circle({0.0, 0.0}, 1.0)}, tolerance, tolerance);
    double worst = 0.0;
    for (int i = -9; i <= 9; ++i)
      worst = std::max(worst,
                       std::abs(trim.crossings(0.1 * i + 0.003).back() - std::sqrt(1 - std::pow(0.1 * i + 0.003, 2))));
    EXPECT_LT(worst, 3.0 * tolerance);
    EXPECT_LT(worst, before);
    before = worst;
  }
}

}  // namespace
}  // namespace flank::internal::verify
