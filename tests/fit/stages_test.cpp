// What passes between the stages of a fit: targets counted once, resolutions changed without a change of shape, pieces
// of advice that their comments give.
#include "flank/fit/stages.h"

#include <gtest/gtest.h>

#include "fit/flat_scene.h"
#include "seed/exact_targets.h"

namespace flank::internal {
namespace {

using testing::cylinder;
using testing::standing_blade;
using testing::upright_motion;

TEST(Stages, StripsThatShareATargetCountItOnceInTheirOrder) {
  const auto a = standing_blade(0.0), b = standing_blade(-5.0);
  FitDraft draft;
  draft.targets = {b.get(), a.get(), b.get(), a.get()};
  EXPECT_EQ(distinct_targets(draft), (std::vector<const Target*>{b.get(), a.get()}));
  EXPECT_TRUE(distinct_targets({}).empty());
}

TEST(Stages, ChecksBelongToTheirTarget) {
  const auto a = standing_blade(0.0), b = standing_blade(-5.0);
  const ObstacleField obstacles(testing::only(testing::hub(true)), *a, 2.0, 0.0);
  FitDraft draft;
  draft.targets = {b.get(), a.get()};
  EXPECT_EQ(obstacles_of(draft, a.get()), nullptr) << "no obstacles at all";
  draft.obstacles = {nullptr, &obstacles};
  EXPECT_EQ(obstacles_of(draft, a.get()), &obstacles);
  EXPECT_EQ(obstacles_of(draft, b.get()), nullptr);
}

FitDraft barrel_draft(const testing::ExactTarget& exact) {
  FitDraft draft;
  draft.targets = {exact.target.get()};
  draft.motions = {exact.motion};
  draft.tool = exact.tool;
  return draft;
}

TEST(Stages, MoreControlPointsLeaveTheMotionAsItIs) {
  const testing::ExactTarget exact = testing::barrel_target();
  FitDraft next;
  FitStage stage;
  stage.control_points = 17;
  const FitState state = start_state(barrel_draft(exact), stage, next);
  ASSERT_EQ(state.motions.size(), 1u);
  EXPECT_EQ(state.motions.front().tip.count(), 17);
  EXPECT_EQ(state.motions.front().direction.count(), 17);
  EXPECT_EQ(state.motions.front().axis_length, exact.motion.axis_length);
  for (int i = 0; i <= 50; ++i) {
    const Pose was = exact.motion.pose(i / 50.0), is = state.motions.front().pose(i / 50.0);
    EXPECT_LT((was.tip - is.tip).norm(), 1e-4);
    EXPECT_LT((was.at(40.0) - is.at(40.0)).norm(), 1e-3);
  }
  stage.control_points = 4;
  const FitState same = start_state(barrel_draft(exact), stage, next);
  EXPECT_EQ(same.motions.front().tip.poles, exact.motion.tip.poles) << "the number it has already: not fitted again";
}

TEST(Stages, AFreeToolBecomesASplineOfTheStagesSizeWithAllOfItFree) {
  const testing::ExactTarget exact = testing::barrel_target();
  FitDraft draft = barrel_draft(exact), next;
  draft.free_tool = true;
  draft.free_parameters = {0};  // of the barrel: says nothing of the spline
  FitStage stage;
  stage.tool_coefficients = 14;
  const FitState state = start_state(draft, stage, next);
  EXPECT_EQ(state.tool.family(), ToolFamily::kSpline);
  EXPECT_EQ(state.tool.parameter_count(), 14);
  EXPECT_EQ(next.free_parameters, testing::all_parameters(state.tool));
  for (int j = 0; j <= 40; ++j) EXPECT_NEAR(state.tool.at(j).r, exact.tool.at(j).r, 1e-4);
}

TEST(Stages, AGivenToolKeepsItsFamilyAndItsListOfFreeParameters) {
  const testing::ExactTarget exact = testing::barrel_target();
  FitDraft draft = barrel_draft(exact), next;
  draft.free_parameters = {1};
  const FitState state = start_state(draft, FitStage{}, next);
  EXPECT_EQ(state.tool.family(), ToolFamily::kBarrel);
  EXPECT_EQ(state.tool.parameters(), exact.tool.parameters());
  EXPECT_EQ(next.free_parameters, std::vector<int>{1});
}

TEST(Stages, APassLowersTheErrorAndAppendsToTheTrace) {
  const auto blade = standing_blade(0.0);
  FitDraft draft;
  draft.targets = {blade.get()};
  draft.motions = {upright_motion({.y = 5.6})};
  draft.tool = cylinder(5.0);
  std::vector<IterationTrace> trace(2);
  ResidualSummary summary;
  const FitDraft next = run_stage(draft, {}, quick_stage(0.3), &trace, &summary);
  ASSERT_GT(trace.size(), 3u);
  EXPECT_EQ(trace[1].cost, 0.0) << "what the caller had in it";
  EXPECT_NEAR(trace[2].rms_mm, 0.6, 1e-6);
  EXPECT_LT(trace.back().rms_mm, 1e-3);
  EXPECT_EQ(summary.rms_mm, trace.back().rms_mm);
  EXPECT_NEAR(next.motions.front().pose(0.5).at(15.0).y(), 5.0, 1e-3);
  EXPECT_EQ(next.motions.front().tip.count(), quick_stage(0.3).control_points);
  EXPECT_EQ(next.tool.parameters()[0], 5.0);
  EXPECT_EQ(next.targets, draft.targets);
}

TEST(Stages, APassFindsOnlyTheParametersThatAreFree) {
  const testing::ExactTarget exact = testing::cone_target();
  FitDraft draft = barrel_draft(exact);
  draft.tool = exact.tool.with_parameters(Eigen::Vector2d(4.2, 0.08));
  draft.free_parameters = {0};
  FitStage stage = polish_stage(1.0);
  stage.samples_t = 40;
  stage.samples_s = 12;
  stage.control_points = 12;
  ResidualSummary summary;
  const FitDraft next = run_stage(draft, {}, stage, nullptr, &summary);
  EXPECT_EQ(next.tool.parameters()[1], 0.08);
  EXPECT_LT(summary.rms_mm, 2e-3);
}

TEST(Stages, LaterPassesAreFinerAndFreer) {
  const FitStage quick = quick_stage(0.5), fine = polish_stage(0.5), exact = exact_stage(false),
                 last = exact_stage(true);
  for (const auto& [a, b] : {std::pair{&quick, &fine}, std::pair{&fine, &exact}, std::pair{&exact, &last}}) {
    EXPECT_LT(a->samples_t, b->samples_t);
    EXPECT_LT(a->control_points, b->control_points);
    EXPECT_GT(a->fairness, b->fairness);
    EXPECT_GT(a->transversal_anchor, b->transversal_anchor);
    EXPECT_GT(a->axial_pin, b->axial_pin);
  }
  // Of an envelope nothing may pull that is not on it.
  EXPECT_EQ(exact.extension_weight, 0.0);
  EXPECT_EQ(exact.robust_scale_mm, 0.0);
  EXPECT_EQ(exact.dead_zone_mm, 0.0);
  EXPECT_EQ(quick.robust_scale_mm, 0.5);
  EXPECT_TRUE(quick.clear_estimated);
  EXPECT_FALSE(fine.clear_estimated);
  EXPECT_DOUBLE_EQ(tolerance_stage(0.02, 0.5, 50.0).dead_zone_mm, 0.014);
}

TEST(Stages, FairnessIsCountedInTolerancesAndBendsOfTheTarget) {
  // Rails that bend by the size over the motion have second differences of size / (n - 1)^2.
  const double size = 80.0, tolerance = 0.05, share = 0.01;
  for (const int n : {40, 120}) {
    const double bend = size / ((n - 1.0) * (n - 1.0));
    EXPECT_NEAR(fairness_of(share, tolerance, size, n) * bend * bend, share * tolerance * tolerance, 1e-15);
  }
  // The same part in other units is fitted in the same way.
  EXPECT_DOUBLE_EQ(fairness_of(share, tolerance, size, 120), fairness_of(share, 1e-3 * tolerance, 1e-3 * size, 120));
  FitStage small, large;
  set_motion_weights(small, tolerance, size);
  set_motion_weights(large, 1e3 * tolerance, 1e3 * size);
  EXPECT_DOUBLE_EQ(small.plunge_weight, large.plunge_weight);
  EXPECT_DOUBLE_EQ(small.lag_weight, large.lag_weight);
  EXPECT_GT(small.lag_weight, 0.0);
}

TEST(Stages, EveryPassHasSamplesEnoughForItsUnknowns) {
  for (const FitStage& stage :
       {quick_stage(1.0), polish_stage(1.0), exact_stage(false), exact_stage(true), tolerance_stage(0.01, 1.0, 50.0)}) {
    EXPECT_GE(stage.samples_t, 2 * stage.control_points);
    EXPECT_GT(stage.samples_s, stage.tool_coefficients);
    EXPECT_GE(stage.tool_coefficients, 4);
    EXPECT_GT(stage.iterations, 0);
  }
}

TEST(Stages, ClampingHoldsASplineWithinItsBoundsEverywhere) {
  Eigen::VectorXd radii(7);
  radii << 3.0, 9.0, 2.0, 5.0, 5.5, 12.0, 4.0;
  const RadiusBounds bounds{4.0, 8.0, 0.9};
  const RadialFunction clamped = clamp_tool(RadialFunction::spline(30.0, radii), bounds);
  for (int j = 0; j <= 300; ++j) {
    EXPECT_GE(clamped.at(0.1 * j).r, 4.0 - 1e-12);
    EXPECT_LE(clamped.at(0.1 * j).r, 8.0 + 1e-12);
  }
  EXPECT_EQ(clamped.parameters()[3], 5.0) << "what is inside stays";
  EXPECT_EQ(clamp_tool(cylinder(20.0), bounds).parameters()[0], 20.0) << "a family is given, not clamped";
}

}  // namespace
}  // namespace flank::internal
