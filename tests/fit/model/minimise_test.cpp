// The minimiser over the model of the fit, and the model's own figures: sample weights, moves, summaries. The target is
// a plane, so that distances are known.
#include "flank/fit/model/minimise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "fit/flat_scene.h"
#include "flank/threads.h"

namespace flank::internal {
namespace {

using testing::all_parameters;
using testing::bare_stage;
using testing::cylinder;
using testing::standing_blade;
using testing::state_of;
using testing::Upright;
using testing::upright_motion;

class Minimise : public ::testing::Test {
 protected:
  FitModel model_of(const FitState& start, const FitStage& stage, bool free_tool = true) const {
    return {std::vector<const Target*>(start.motions.size(), blade_.get()),
            start,
            free_tool ? all_parameters(start.tool) : std::vector<int>{},
            {},
            stage};
  }
  std::unique_ptr<Target> blade_ = standing_blade(0.0);
};

TEST_F(Minimise, ResidualsAreDistancesLessRadii) {
  const FitState start =
      state_of({upright_motion({.y = 5.4})}, RadialFunction(ToolFamily::kCone, 30.0, Eigen::Vector2d(5.0, 0.02)));
  const FitModel model = model_of(start, bare_stage());
  FitState state = start;
  model.locate(state);
  for (int i = 0; i < 21; i += 5)
    for (int j = 0; j < 11; ++j)
      EXPECT_NEAR(model.residual(state, 0, i, j), 0.4 - 3.0 * j * std::sin(0.02), 1e-9) << i << ' ' << j;
  EXPECT_NEAR((model.point(state, 0, 20, 10) - Vec3(56.0, 5.4, 32.0)).norm(), 0.0, 1e-9);
}

TEST_F(Minimise, WeightsAreEqualSharesInsideAndLessPastTheBorder) {
  FitStage stage = bare_stage();
  stage.extension_weight = 0.25;
  // Two motions; the second runs past the border x = 60 with its last samples.
  const FitState start = state_of({upright_motion(), upright_motion({.x_last = 63.0})}, cylinder(5.0));
  const FitModel model = model_of(start, stage);
  FitState state = start;
  model.locate(state);
  const auto weights = model.sample_weights(state);
  const double share = 1.0 / (2.0 * 21.0 * 11.0);
  for (const double w : weights[0]) EXPECT_DOUBLE_EQ(w, share);
  EXPECT_EQ(state.feet[1].back().location, Location::kExtension);
  EXPECT_DOUBLE_EQ(weights[1].back(), 0.25 * share);
  EXPECT_DOUBLE_EQ(weights[1].front(), share);
}

TEST_F(Minimise, WeightsFallRobustlyWithTheResidualAndRiseForOvercut) {
  FitStage stage = bare_stage();
  stage.robust_scale_mm = 0.1;
  stage.overcut_weight = 4.0;
  const double share = 1.0 / (21.0 * 11.0);
  for (const double e : {-0.2, 0.1, 0.3}) {
    const FitState start = state_of({upright_motion({.y = 5.0 + e})}, cylinder(5.0));
    const FitModel model = model_of(start, stage);
    FitState state = start;
    model.locate(state);
    const double expected = share * (e < 0.0 ? 4.0 : 1.0) / std::pow(1.0 + e * e / 0.01, 2);
    const auto weights = model.sample_weights(state);
    for (const double w : weights[0]) EXPECT_NEAR(w, expected, 1e-8 * share) << e;
  }
}

TEST_F(Minimise, TheDeadZoneIsTakenOffTheResidualOnBothSides) {
  FitStage stage = bare_stage();
  stage.dead_zone_mm = 0.1;
  for (const double e : {-0.3, -0.1, 0.05, 0.25}) {
    const FitState start = state_of({upright_motion({.y = 5.0 + e})}, cylinder(5.0));
    const FitModel model = model_of(start, stage);
    FitState state = start;
    model.locate(state);
    const double beyond = std::max(0.0, std::abs(e) - 0.1);
    EXPECT_NEAR(model.cost(state, model.sample_weights(state)), beyond * beyond, 1e-9) << e;
  }
}

TEST_F(Minimise, AMoveIsInMillimetresOfTipEndAndRadius) {
  const FitState start =
      state_of({upright_motion()}, RadialFunction(ToolFamily::kCone, 30.0, Eigen::Vector2d(5.0, 0.02)));
  const FitModel model(std::vector<const Target*>{blade_.get()}, start, {1}, {}, bare_stage());
  Eigen::VectorXd step = Eigen::VectorXd::Zero(model.make_system().size());
  ASSERT_EQ(step.size(), 6 * 8 + 1);
  for (int k = 0; k < 8; ++k) step.segment<6>(6 * k) << 1.0, 2.0, 3.0, 0.3, -0.6, 0.9;
  step[48] = 0.01;
  const FitState moved = model.moved(start, step);
  const RuledMotion &a = start.motions.front(), &b = moved.motions.front();
  EXPECT_NEAR((b.tip.value(0.3) - a.tip.value(0.3) - Vec3(1.0, 2.0, 3.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((b.direction.value(0.3) - a.direction.value(0.3) - Vec3(0.01, -0.02, 0.03)).norm(), 0.0, 1e-12);
  EXPECT_EQ(moved.tool.parameters()[0], 5.0) << "not free";
  EXPECT_DOUBLE_EQ(moved.tool.parameters()[1], 0.03);
}

TEST_F(Minimise, TheSummaryIsOfSamplesInsideTheTarget) {
  const FitState start =
      state_of({upright_motion({.y = 4.8}), upright_motion({.y = 4.8, .x_last = 64.0})}, cylinder(5.0));
  const FitModel model = model_of(start, bare_stage());
  FitState state = start;
  model.locate(state);
  const ResidualSummary summary = summarise_residuals(model, state);
  EXPECT_NEAR(summary.rms_mm, 0.2, 1e-9);
  EXPECT_NEAR(summary.largest_mm, 0.2, 1e-9);
  EXPECT_NEAR(summary.largest_overcut_mm, 0.2, 1e-9);
  // The second motion is past x = 60 from t = 56/60 on: times 19 and 20 of 0 to 20.
  EXPECT_NEAR(summary.inside_share, 1.0 - 2.0 / 42.0, 1e-12);
}

TEST_F(Minimise, PutsAGivenCylinderOntoThePlane) {
  FitStage stage = bare_stage();
  stage.fairness = 1e-4;
  stage.transversal_anchor = stage.axial_pin = 1e-2;
  FitState start = state_of({upright_motion({.y = 5.7})}, cylinder(5.0));
  start.motions.front().direction.poles.row(1).array() += 0.03;
  const MinimiseResult result = minimise(model_of(start, stage, false), start);
  EXPECT_LT(result.trace.back().largest_mm, 1e-8);
  for (const double t : {0.0, 0.37, 1.0}) {
    EXPECT_NEAR(result.state.motions.front().pose(t).tip.y(), 5.0, 1e-8);
    EXPECT_NEAR(result.state.motions.front().pose(t).at(30.0).y(), 5.0, 1e-8);
  }
  EXPECT_EQ(result.state.tool.parameters()[0], 5.0);
}

TEST_F(Minimise, ARadiusPinDecidesBetweenTheToolAndTheAxis) {
  // Tool and axis can shift together along the normal: without a pin the nearer of both gives way, with one the radius
  // stays.
  FitStage stage = bare_stage();
  stage.transversal_anchor = stage.axial_pin = 1e-2;
  const FitState start = state_of({upright_motion({.y = 5.5})}, cylinder(5.0));
  const MinimiseResult open = minimise(model_of(start, stage), start);
  stage.radius_pin = 1e3;
  const MinimiseResult pinned = minimise(model_of(start, stage), start);
  for (const MinimiseResult* result : {&open, &pinned}) EXPECT_LT(result->trace.back().largest_mm, 1e-5);
  EXPECT_GT(open.state.tool.parameters()[0], 5.01);
  EXPECT_NEAR(pinned.state.tool.parameters()[0], 5.0, 1e-5);
}

TEST_F(Minimise, AToolTurnsIntoTheConeThatThePlaneAsksFor) {
  // The axis is held by its anchors only along its travel; it leans, and the spline learns the slope or the axis the
  // plane: either way nothing is left, and the bounds on the radius hold.
  FitStage stage = bare_stage();
  stage.tool_fairness = 1e-9;
  stage.transversal_anchor = stage.axial_pin = 1e-2;
  FitState start = state_of({upright_motion()}, RadialFunction::spline(30.0, Eigen::VectorXd::Constant(6, 5.0)));
  start.motions.front().direction.poles.row(1).array() += 0.05;
  const FitModel model({blade_.get()}, start, all_parameters(start.tool), {4.9, 6.0, 0.5}, stage);
  const MinimiseResult result = minimise(model, start);
  EXPECT_LT(result.trace.back().largest_mm, 1e-6);
  for (int j = 0; j <= 30; ++j) {
    EXPECT_GT(result.state.tool.at(j).r, 4.9 - 1e-6);
    EXPECT_LT(result.state.tool.at(j).r, 6.0 + 1e-6);
  }
}

TEST_F(Minimise, IsTheSameForOneAndThreeThreads) {
  FitStage stage = bare_stage();
  stage.iterations = 4;
  stage.transversal_anchor = stage.axial_pin = 1e-2;
  const ObstacleField obstacles(testing::only(testing::hub(true)), *blade_, 2.0, 0.0);
  const FitState start = state_of({upright_motion({.y = 5.7, .z = 4.0})}, cylinder(5.0));
  const FitModel model({blade_.get()}, start, {0}, {}, stage, {&obstacles});
  set_thread_count(1);
  const MinimiseResult one = minimise(model, start);
  set_thread_count(3);
  const MinimiseResult three = minimise(model, start);
  set_thread_count(0);
  EXPECT_EQ(one.state.motions.front().tip.poles, three.state.motions.front().tip.poles);
  EXPECT_EQ(one.state.tool.parameters(), three.state.tool.parameters());
}

TEST(DistanceGradient, IsTheNormalInsideAndTheDirectionToThePointAtTheBorder) {
  Footpoint foot;
  foot.normal = Vec3::UnitZ();
  const Vec3 p(3.0, 0.0, 4.0);
  for (const Location location : {Location::kInside, Location::kExtension}) {
    foot.location = location;
    EXPECT_EQ(distance_gradient(p, foot), Vec3(0.0, 0.0, 1.0));
  }
  foot.location = Location::kBorder;
  foot.distance = 5.0;
  EXPECT_LT((distance_gradient(p, foot) - Vec3(0.6, 0.0, 0.8)).norm(), 1e-15);
  foot.distance = -5.0;
  EXPECT_LT((distance_gradient(p, foot) + Vec3(0.6, 0.0, 0.8)).norm(), 1e-15) << "on the material's side";
  EXPECT_EQ(distance_gradient(foot.point, foot), Vec3(0.0, 0.0, 1.0)) << "no direction at the point itself";
}

}  // namespace
}  // namespace flank::internal
