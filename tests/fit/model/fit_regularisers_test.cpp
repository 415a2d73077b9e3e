// Fairness, anchors, pins and the tool's bounds: each term alone against its closed form, and every derivative against
// central differences.
#include <gtest/gtest.h>

#include <cmath>

#include "fit/flat_scene.h"
#include "flank/fit/model/fit_model.h"
#include "seed/exact_targets.h"

namespace flank::internal {
namespace {

using testing::all_parameters;
using testing::bare_stage;
using testing::cylinder;
using testing::expect_regulariser_gradient;
using testing::state_of;
using testing::upright_motion;

constexpr double kLength = 30.0;
/// Weight of the one-sided terms of the tool's bounds, and of the term that holds |w| at one.
constexpr double kBoundWeight = 10.0, kUnitWeight = 1e-9;

/// The terms never ask the target: none is needed.
FitModel model_of(const FitState& start, const FitStage& stage, const RadiusBounds& bounds = {},
                  bool free_tool = true) {
  return {std::vector<const Target*>(start.motions.size(), nullptr), start,
          free_tool ? all_parameters(start.tool) : std::vector<int>{}, bounds, stage};
}

FitState shifted(FitState state, const Vec3& by) {
  state.motions.front().tip.poles.colwise() += by;
  return state;
}

/// Poles of the clamped cubic rail t^2 v (by its blossom).
Eigen::Matrix3Xd square_poles(const Vec3& v, int count) {
  const std::vector<double> knots = uniform_knots(3, count);
  Eigen::Matrix3Xd poles(3, count);
  for (int k = 0; k < count; ++k) {
    const auto i = static_cast<std::size_t>(k) + 1;
    const double a = knots[i], b = knots[i + 1], c = knots[i + 2];
    poles.col(k) = (a * b + b * c + c * a) / 3.0 * v;
  }
  return poles;
}

TEST(FitRegularisers, AMotionAtTheStartPaysNothingButFairness) {
  FitStage stage = bare_stage();
  stage.transversal_anchor = stage.axial_pin = stage.radius_pin = 1.0;
  const FitState start = state_of({upright_motion()}, cylinder(5.0));
  EXPECT_NEAR(model_of(start, stage).regulariser_cost(start), 0.0, 1e-20);
}

TEST(FitRegularisers, FairnessIsTheMeanSquareOfSecondDifferences) {
  FitStage stage = bare_stage();
  stage.fairness = 3.0;
  FitState state = state_of({upright_motion()}, cylinder(5.0));
  const FitModel model = model_of(state, stage);
  EXPECT_NEAR(model.regulariser_cost(state), 0.0, 1e-18) << "a straight rail at constant speed is fair";
  const Vec3 bend(0.0, 4.0, 1.0), turn(0.02, 0.01, 0.0);
  state.motions.front().tip.poles += square_poles(bend, 8);
  state.motions.front().direction.poles += square_poles(turn, 8);
  // t^2 has second difference 2 h^2 between samples h apart; the direction counts as far as it moves the axis' end.
  const double h = 1.0 / (stage.samples_t - 1), second = 2.0 * h * h;
  const double expected = 3.0 * second * second * (bend.squaredNorm() + kLength * kLength * turn.squaredNorm());
  FitStage without = stage;
  without.fairness = 0.0;
  const double rest = model_of(state, without).regulariser_cost(state);
  EXPECT_NEAR(model.regulariser_cost(state) - rest, expected, 1e-7 * expected);
}

TEST(FitRegularisers, TheAnchorHoldsTheMiddleOfTheAxisAlongItsTravelOnly) {
  FitStage stage = bare_stage();
  stage.transversal_anchor = 2.0;
  const FitState start = state_of({upright_motion()}, cylinder(5.0));
  const FitModel model = model_of(start, stage);
  EXPECT_NEAR(model.regulariser_cost(shifted(start, Vec3(0.3, 0.0, 0.0))), 2.0 * 0.09, 1e-12);
  EXPECT_NEAR(model.regulariser_cost(shifted(start, Vec3(0.0, 0.3, 0.2))), 0.0, 1e-20);
  FitState turned = start;
  const double angle = 0.1;
  turned.motions.front().direction.poles.colwise() = Vec3(std::sin(angle), 0.0, std::cos(angle));
  const double drift = 0.5 * kLength * std::sin(angle);
  EXPECT_NEAR(model.regulariser_cost(turned), 2.0 * drift * drift, 1e-9);
  turned.motions.front().tip.poles.row(0).array() -= drift;
  EXPECT_NEAR(model.regulariser_cost(turned), 0.0, 1e-18) << "a turn about the middle is free";
}

TEST(FitRegularisers, TheAxialPinHoldsTheTipAlongTheAxisOnly) {
  FitStage stage = bare_stage();
  stage.axial_pin = 0.5;
  const FitState start = state_of({upright_motion()}, cylinder(5.0));
  const FitModel model = model_of(start, stage);
  EXPECT_NEAR(model.regulariser_cost(shifted(start, Vec3(0.0, 0.0, -0.4))), 0.5 * 0.16, 1e-12);
  EXPECT_NEAR(model.regulariser_cost(shifted(start, Vec3(0.7, 0.9, 0.0))), 0.0, 1e-20);
}

TEST(FitRegularisers, TheLengthOfTheDirectionIsHeldWeaklyAtOne) {
  const FitState start = state_of({upright_motion()}, cylinder(5.0));
  FitState stretched = start;
  stretched.motions.front().direction.poles *= 1.2;
  const double expected = kUnitWeight * std::pow(0.2 * kLength, 2);
  EXPECT_NEAR(model_of(start, bare_stage()).regulariser_cost(stretched), expected, 1e-9 * expected);
}

TEST(FitRegularisers, TheRadiusPinIsTheMeanSquareChangeOfTheRadius) {
  FitStage stage = bare_stage();
  stage.radius_pin = 4.0;
  const FitState start =
      state_of({upright_motion()}, RadialFunction::spline(kLength, Eigen::VectorXd::Constant(7, 5.0)));
  FitState thicker = start;
  thicker.tool = start.tool.with_parameters(Eigen::VectorXd::Constant(7, 5.25));
  EXPECT_NEAR(model_of(start, stage).regulariser_cost(thicker), 4.0 * 0.0625, 1e-12);
}

TEST(FitRegularisers, ToolFairnessIsTheSumOfSquaredSecondDifferences) {
  FitStage stage = bare_stage();
  stage.tool_fairness = 0.1;
  Eigen::VectorXd even(6), uneven(6);
  even << 5.0, 5.1, 5.2, 5.3, 5.4, 5.5;
  uneven << 5.0, 5.1, 5.4, 5.3, 5.4, 5.5;
  const FitState start = state_of({upright_motion()}, RadialFunction::spline(kLength, even));
  FitState bumpy = start;
  bumpy.tool = start.tool.with_parameters(uneven);
  const FitModel model = model_of(start, stage);
  EXPECT_NEAR(model.regulariser_cost(start), 0.0, 1e-18);
  EXPECT_NEAR(model.regulariser_cost(bumpy), 0.1 * (0.2 * 0.2 + 0.4 * 0.4 + 0.2 * 0.2), 1e-9);
}

TEST(FitRegularisers, RadiiOutOfBoundsPayTheSquareOfTheirExcess) {
  const RadiusBounds bounds{4.0, 6.0, 0.9};
  // Held a little above the smallest: what a last look finds too deep is taken off there.
  constexpr double kInside = 0.002;
  for (const double radius : {3.7, 4.0, 4.01, 5.0, 6.0, 6.2}) {
    const double excess = std::max({0.0, (1.0 + kInside) * 4.0 - radius, radius - 6.0});
    const FitState state = state_of({upright_motion()}, cylinder(radius));
    EXPECT_NEAR(model_of(state, bare_stage(), bounds).regulariser_cost(state), kBoundWeight * excess * excess, 1e-12)
        << radius;
  }
}

TEST(FitRegularisers, SlopesOutOfBoundsPayInLengthsOfTheAxis) {
  const RadiusBounds bounds{0.0, 1e3, 0.2};
  for (const double slope : {-0.25, -0.2, 0.1, 0.23}) {
    const FitState state = state_of(
        {upright_motion()}, RadialFunction(ToolFamily::kCone, kLength, Eigen::Vector2d(20.0, std::asin(slope))));
    const double excess = kLength * std::max(0.0, std::abs(slope) - 0.2);
    EXPECT_NEAR(model_of(state, bare_stage(), bounds).regulariser_cost(state), kBoundWeight * excess * excess, 1e-9)
        << slope;
  }
}

TEST(FitRegularisers, SpheresThatAreHardlyInscribedPay) {
  // r = 20 + bend x^2: at mid-length r' = 0 and 1 - r r'' = 1 - 40 bend, which is to stay above 0.05.
  FitStage stage = bare_stage();
  stage.samples_s = 3;
  const auto cost = [&](double bend) {
    const RadialFunction tool(ToolFamily::kHyperbolic, kLength, Eigen::Vector3d(20.0, 0.0, bend));
    const FitState state = state_of({upright_motion()}, tool);
    double sum = 0.0;
    for (const double x : {-15.0, 0.0, 15.0}) {
      const double r = 20.0 + bend * x * x, d1 = 2.0 * bend * x;
      const double lack = kLength * std::max(0.0, 0.05 - (1.0 - d1 * d1 - 2.0 * bend * r));
      sum += kBoundWeight * lack * lack / 3.0;
    }
    EXPECT_NEAR(model_of(state, stage).regulariser_cost(state), sum, 1e-9 * std::max(1.0, sum)) << bend;
    return sum;
  };
  EXPECT_EQ(cost(-0.02), 0.0);
  EXPECT_EQ(cost(0.01), 0.0);
  EXPECT_GT(cost(0.03), 1.0);
}

TEST(FitRegularisers, AGivenToolPaysForNoBound) {
  const FitState state = state_of({upright_motion()}, cylinder(9.0));
  const RadiusBounds bounds{4.0, 6.0, 0.9};
  EXPECT_GT(model_of(state, bare_stage(), bounds).regulariser_cost(state), 1.0);
  EXPECT_NEAR(model_of(state, bare_stage(), bounds, false).regulariser_cost(state), 0.0, 1e-18);
}

TEST(FitRegularisers, SeveralMotionsPayTheMean) {
  FitStage stage = bare_stage();
  stage.axial_pin = 1.0;
  const FitState start = state_of({upright_motion(), upright_motion({.y = 9.0})}, cylinder(5.0));
  FitState slid = start;
  slid.motions[1].tip.poles.row(2).array() += 0.6;
  EXPECT_NEAR(model_of(start, stage).regulariser_cost(slid), 0.5 * 0.36, 1e-12);
}

/// One term switched on, or a bound that the start breaks.
struct Term {
  const char* name = "";
  double FitStage::*weight = nullptr;
  RadiusBounds bounds;
};

class RegulariserDerivative : public ::testing::TestWithParam<Term> {};

/// Off the start of the model, so that anchors and pins pull.
FitState bent_state(const RadialFunction& tool) {
  RuledMotion motion = testing::bent_motion(kLength);
  motion.direction.poles *= 1.05;
  return state_of({motion}, tool);
}

void expect_derivative(const RadialFunction& tool, const Term& term, double accuracy = 1e-5) {
  FitStage stage = bare_stage(4);
  if (term.weight != nullptr) stage.*term.weight = 1.0;
  const FitState start = bent_state(tool);
  const FitModel model = model_of(start, stage, term.bounds);
  FitState state = start;
  state.motions.front().tip.poles.colwise() += Vec3(0.3, -0.2, 0.5);
  state.motions.front().direction.poles.col(2) += Vec3(0.05, 0.02, 0.0);
  state.tool = tool.with_parameters(tool.parameters() + 1e-3 * Eigen::VectorXd::Ones(tool.parameter_count()));
  expect_regulariser_gradient(model, state, accuracy);
}

TEST_P(RegulariserDerivative, OfASplineAgreesWithDifferences) {
  Eigen::VectorXd radii(7);
  radii << 5.0, 5.4, 6.1, 6.0, 6.6, 6.2, 5.1;
  expect_derivative(RadialFunction::spline(kLength, radii), GetParam());
}

TEST_P(RegulariserDerivative, OfABarrelAgreesWithDifferences) {
  expect_derivative(RadialFunction(ToolFamily::kBarrel, kLength, Eigen::Vector3d(90.0, 6.0, 12.0)), GetParam());
}

TEST_P(RegulariserDerivative, OfAHyperbolicToolAgreesWithDifferences) {
  expect_derivative(RadialFunction(ToolFamily::kHyperbolic, kLength, Eigen::Vector3d(22.0, 0.03, 0.01)), GetParam());
}

TEST(FitRegularisers, TheDerivativeOfTheConvexityAgreesWithDifferences) {
  // The model takes r'' by second differences: four digits.
  for (const double bend : {0.022, 0.03})
    expect_derivative(RadialFunction(ToolFamily::kHyperbolic, kLength, Eigen::Vector3d(22.0, 0.03, bend)), {}, 1e-4);
  Eigen::VectorXd radii = Eigen::VectorXd::Constant(7, 40.0);
  radii[3] -= 4.0;
  expect_derivative(RadialFunction::spline(kLength, radii), {}, 1e-4);
}

TEST(FitRegularisers, AMotionThatStandsStillLagsAndOneOfEvenSpeedDoesNot) {
  FitStage stage = bare_stage(8);
  stage.lag_weight = 1.0;
  const FitState even = state_of({testing::upright_motion()}, testing::cylinder(5.0));
  const FitModel model = model_of(even, stage, {});
  const double still = model.regulariser_cost(even);
  FitState late = even;
  // The same way, but all in the last half of the time.
  BSplineCurve3& tip = late.motions.front().tip;
  for (int k = 1; k <= 4; ++k) tip.poles.col(k) = tip.poles.col(0);
  // A quarter of the speed of 52 mm is missing for two fifths of the time and more.
  EXPECT_GT(model.regulariser_cost(late) - still, 0.4 * 13.0 * 13.0);
  expect_regulariser_gradient(model, late, 1e-5);
}

/// Two motions that lean by an angle each way along x.
FitState leaning_apart(double angle) {
  FitState state = state_of({upright_motion(), upright_motion({.y = 25.0})}, cylinder(5.0));
  for (const double sign : {1.0, -1.0})
    state.motions[sign > 0.0 ? 0 : 1].direction.poles.colwise() = Vec3(sign * std::sin(angle), 0.0, std::cos(angle));
  return state;
}

TEST(FitRegularisers, FacingAxesPayForWhatTheyLeanMoreThanBothOnAverage) {
  FitStage stage = bare_stage();
  stage.parallel_weight = 3.0;
  const FitState parallel = leaning_apart(0.0), apart = leaning_apart(0.1);
  EXPECT_NEAR(model_of(parallel, stage).regulariser_cost(parallel), 0.0, 1e-18);
  const double off = kLength * std::sin(0.1);
  EXPECT_NEAR(model_of(apart, stage).regulariser_cost(apart), 3.0 * off * off, 1e-9);
  // Both alike, however much, is what they are drawn to.
  FitState alike = apart;
  alike.motions[1].direction = alike.motions[0].direction;
  EXPECT_NEAR(model_of(alike, stage).regulariser_cost(alike), 0.0, 1e-12);
}

TEST(FitRegularisers, TheDerivativeOfFacingAxesAgreesWithDifferences) {
  FitStage stage = bare_stage(8);
  stage.parallel_weight = 1.0;
  const FitModel model = model_of(leaning_apart(0.15), stage);
  FitState state = leaning_apart(0.11);
  state.motions[0].direction.poles.col(3) += Vec3(0.05, 0.03, 0.1);
  state.motions[1].tip.poles.col(2) += Vec3(0.4, -0.2, 0.1);
  expect_regulariser_gradient(model, state, 1e-5);
}

INSTANTIATE_TEST_SUITE_P(
    Terms, RegulariserDerivative,
    ::testing::Values(Term{"Fairness", &FitStage::fairness, {}}, Term{"Anchor", &FitStage::transversal_anchor, {}},
                      Term{"AxialPin", &FitStage::axial_pin, {}}, Term{"RadiusPin", &FitStage::radius_pin, {}},
                      Term{"ToolFairness", &FitStage::tool_fairness, {}}, Term{"Plunge", &FitStage::plunge_weight, {}},
                      Term{"Lag", &FitStage::lag_weight, {}}, Term{"UnitLength", nullptr, {}},
                      Term{"SmallestRadius", nullptr, {7.0, 1e3, 0.95}},
                      Term{"LargestRadius", nullptr, {0.0, 5.5, 0.95}},
                      Term{"SteepestSlope", nullptr, {0.0, 1e3, 0.01}}),
    [](const auto& term) { return std::string(term.param.name); });

}  // namespace
}  // namespace flank::internal
