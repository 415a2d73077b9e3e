// Smallest, largest and steepest of a radial function against dense samples, and where samples would miss them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "flank/base/random.h"
#include "flank/radial_function.h"

namespace flank::internal {
namespace {

constexpr double kLength = 20.0;

Eigen::VectorXd values(std::initializer_list<double> list) {
  Eigen::VectorXd v(static_cast<Eigen::Index>(list.size()));
  std::copy(list.begin(), list.end(), v.begin());
  return v;
}

struct Extremes {
  double smallest = std::numeric_limits<double>::infinity(), largest = -smallest, steepest = 0.0;
};

Extremes sampled(const RadialFunction& f, int steps) {
  Extremes e;
  for (int i = 0; i <= steps; ++i) {
    const RadialJet jet = f.at(f.axis_length() * i / steps);
    e.smallest = std::min(e.smallest, jet.r);
    e.largest = std::max(e.largest, jet.r);
    e.steepest = std::max(e.steepest, std::abs(jet.d1));
  }
  return e;
}

/// No sample may lie beyond the extremes, and the extremes no farther beyond the samples than r bends between them.
void expect_exact(const RadialFunction& f, const std::string& name) {
  constexpr int kSteps = 1000;
  const Extremes e = sampled(f, kSteps);
  double bend = 0.0, jerk = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double s = f.axis_length() * i / kSteps, next = f.axis_length() * (i + 1) / kSteps;
    bend = std::max({bend, std::abs(f.at(s).d2), std::abs(f.at(next).d2)});
    jerk = std::max(jerk, std::abs(f.at(next).d2 - f.at(s).d2));
  }
  const double h = f.axis_length() / kSteps, size = std::abs(e.largest) + std::abs(e.smallest);
  const double slack_r = h * h * bend / 4.0, slack_slope = h * jerk, round_off = 1e-14 * (size + 1.0);
  EXPECT_LE(f.smallest(), e.smallest + round_off) << name;
  EXPECT_GE(f.smallest(), e.smallest - slack_r - round_off) << name;
  EXPECT_GE(f.largest(), e.largest - round_off) << name;
  EXPECT_LE(f.largest(), e.largest + slack_r + round_off) << name;
  EXPECT_GE(f.steepest(), e.steepest - 1e-13 * (1.0 + e.steepest)) << name;
  EXPECT_LE(f.steepest(), e.steepest + slack_slope + 1e-13 * (1.0 + e.steepest)) << name;
}

TEST(RadialExtremes, OfRandomSplinesAreThoseOfDenseSamples) {
  Random random(21);
  for (const int count : {4, 5, 6, 7, 9, 16, 40})
    for (int k = 0; k < 60; ++k) {
      Eigen::VectorXd c(count);
      for (double& x : c) x = random.uniform(-1.0, 5.0);
      expect_exact(RadialFunction::spline(kLength, c), "spline of " + std::to_string(count));
    }
}

TEST(RadialExtremes, OfRandomFamiliesAreThoseOfDenseSamples) {
  Random random(22);
  for (int k = 0; k < 25; ++k) {
    const double radius = random.uniform(2.0, 6.0), arc = random.uniform(30.0, 200.0) * (k % 2 == 0 ? 1.0 : -1.0);
    const double s0 = random.uniform(-10.0, 30.0), angle = random.uniform(-0.6, 0.6);
    expect_exact({ToolFamily::kCylinder, kLength, values({radius})}, "cylinder");
    expect_exact({ToolFamily::kCone, kLength, values({radius, angle})}, "cone");
    expect_exact({ToolFamily::kBarrel, kLength, values({arc, radius, s0})}, "barrel");
    expect_exact({ToolFamily::kLens, kLength, values({radius, radius + random.uniform(-2.0, 2.0)})}, "lens");
    expect_exact({ToolFamily::kTaperedBarrel, kLength, values({arc, radius, angle})}, "tapered barrel");
    expect_exact({ToolFamily::kHyperbolic, kLength, values({radius, 0.3 * angle, random.uniform(-0.02, 0.02)})},
                 "hyperbolic");
    expect_exact({ToolFamily::kPower, kLength, values({30.0, random.uniform(-1, 2), 1.2, random.uniform(0.5, 3.0)})},
                 "power");
  }
}

TEST(RadialExtremes, HaveTheirClosedForms) {
  const RadialFunction barrel(ToolFamily::kBarrel, kLength, values({85.0, 5.0, 8.0}));
  EXPECT_DOUBLE_EQ(barrel.largest(), 5.0);
  EXPECT_DOUBLE_EQ(barrel.smallest(), 85.0 - std::hypot(80.0, 12.0));
  EXPECT_DOUBLE_EQ(barrel.steepest(), 12.0 / std::hypot(80.0, 12.0));
  const RadialFunction waist(ToolFamily::kBarrel, kLength, values({-60.0, 5.0, 8.0}));
  EXPECT_DOUBLE_EQ(waist.smallest(), 5.0);
  const RadialFunction beyond(ToolFamily::kBarrel, kLength, values({85.0, 5.0, 25.0}));
  EXPECT_DOUBLE_EQ(beyond.largest(), beyond.at(kLength).r) << "the thickest place lies beyond the axis";
  const RadialFunction tapered(ToolFamily::kTaperedBarrel, 60.0, values({65.0, 5.0, 0.2}));
  // The top of the arc: its centre is 60 below the axis point at mid-length, tilted by 0.2.
  EXPECT_NEAR(tapered.largest(), 65.0 - 60.0 * std::cos(0.2), 1e-13);
  const RadialFunction cone(ToolFamily::kCone, kLength, values({6.0, -0.2}));
  EXPECT_DOUBLE_EQ(cone.steepest(), std::sin(0.2)) << "the size of the slope, whatever its sign";
  EXPECT_DOUBLE_EQ(cone.smallest(), 6.0 - kLength * std::sin(0.2));
}

/// The spike is narrower than the spacing of 257 samples and lies between two of them.
TEST(RadialExtremes, SeeADipBetweenTheSamples) {
  constexpr int kCount = 2003;
  Eigen::VectorXd c = Eigen::VectorXd::Constant(kCount, 3.0);
  c[1003] = 2.0;
  const RadialFunction f = RadialFunction::spline(kLength, c);
  EXPECT_EQ(sampled(f, 256).smallest, 3.0);
  EXPECT_NEAR(f.smallest(), 3.0 - 2.0 / 3.0, 1e-12) << "the cardinal cubic spline's height is 2/3";
  EXPECT_NEAR(f.largest(), 3.0, 1e-12);
  EXPECT_NEAR(f.steepest(), 2.0 / 3.0 * 2000.0 / kLength, 1e-9) << "its largest slope is 2/3 per span";
}

TEST(RadialExtremes, OfOnePolynomialAreItsOwn) {
  // r = 4 + x^3 - x on one span: from -1 to 1 over the axis, in Bernstein form.
  const Eigen::VectorXd c = values({4.0, 4.0 + 4.0 / 3.0, 4.0 - 4.0 / 3.0, 4.0});
  const RadialFunction f = RadialFunction::spline(kLength, c);
  const double top = 2.0 / (3.0 * std::sqrt(3.0));
  EXPECT_NEAR(f.largest(), 4.0 + top, 1e-14);
  EXPECT_NEAR(f.smallest(), 4.0 - top, 1e-14);
  EXPECT_NEAR(f.steepest(), 2.0 * 2.0 / kLength, 1e-14) << "3 x^2 - 1 at the ends, 2 / L per unit of x";
  // r = 4 + 3 x - x^3: steepest in the middle, flat at both ends.
  const RadialFunction s = RadialFunction::spline(kLength, values({2.0, 2.0, 6.0, 6.0}));
  EXPECT_NEAR(s.smallest(), 2.0, 1e-14);
  EXPECT_NEAR(s.largest(), 6.0, 1e-14);
  EXPECT_NEAR(s.steepest(), 3.0 * 2.0 / kLength, 1e-14);
  // r = 4 + x^3: r' touches zero without a turn.
  const RadialFunction flat = RadialFunction::spline(kLength, values({3.0, 5.0, 3.0, 5.0}));
  EXPECT_NEAR(flat.smallest(), 3.0, 1e-14);
  EXPECT_NEAR(flat.largest(), 5.0, 1e-14);
}

TEST(RadialExtremes, OfConstantAndLinearSplinesAreAtTheEnds) {
  const RadialFunction constant = RadialFunction::spline(kLength, Eigen::VectorXd::Constant(9, 3.25));
  EXPECT_NEAR(constant.smallest(), 3.25, 1e-15);
  EXPECT_NEAR(constant.largest(), 3.25, 1e-14);
  EXPECT_NEAR(constant.steepest(), 0.0, 1e-14);
  const RadialFunction line = RadialFunction::spline(kLength, values({2.0, 3.0, 4.0, 5.0}));
  EXPECT_NEAR(line.smallest(), 2.0, 1e-15);
  EXPECT_NEAR(line.largest(), 5.0, 1e-14);
  EXPECT_NEAR(line.steepest(), 3.0 / kLength, 1e-14);
}

TEST(RadialExtremes, MoveWithTheRadiusAndTurnWithItsSign) {
  Random random(23);
  Eigen::VectorXd c(12);
  for (double& x : c) x = random.uniform(2.0, 5.0);
  const RadialFunction f = RadialFunction::spline(kLength, c);
  const RadialFunction higher = f.with_parameters(c.array() + 1.5);
  EXPECT_NEAR(higher.smallest(), f.smallest() + 1.5, 1e-13);
  EXPECT_NEAR(higher.largest(), f.largest() + 1.5, 1e-13);
  EXPECT_NEAR(higher.steepest(), f.steepest(), 1e-13);
  const RadialFunction turned = f.with_parameters(-c);
  EXPECT_NEAR(turned.smallest(), -f.largest(), 1e-13);
  const RadialFunction reversed = f.with_parameters(c.reverse());
  EXPECT_NEAR(reversed.smallest(), f.smallest(), 1e-13);
  EXPECT_NEAR(reversed.steepest(), f.steepest(), 1e-12);
}

TEST(RadialExtremes, AreNoNumbersWhereTheFormulaHasNoValue) {
  for (const RadialFunction& f : {RadialFunction(ToolFamily::kPower, kLength, values({-1.0, 1.0, 1.0, 2.0})),
                                  RadialFunction(ToolFamily::kPower, kLength, values({1.0, -1.0, 1.0, 2.0})),
                                  RadialFunction(ToolFamily::kBarrel, kLength, values({5.0, 5.0, 8.0})),
                                  RadialFunction(ToolFamily::kLens, kLength, values({15.0, 5.0})),
                                  RadialFunction::spline(kLength, values({3.0, NAN, 3.0, 3.0, 3.0, 3.0, 3.0}))}) {
    EXPECT_TRUE(std::isnan(f.smallest())) << family_name(f.family());
    EXPECT_TRUE(std::isnan(f.largest())) << family_name(f.family());
    EXPECT_TRUE(std::isnan(f.steepest())) << family_name(f.family());
  }
}

}  // namespace
}  // namespace flank::internal
