// The last passes on the swept distance: which points of the faces count and how much, and that each pass keeps or
// improves what it was given. The blades are flat or slightly twisted.
#include "flank/fit/swept_polish.h"
#include "flank/fit/coverage.h"
#include "flank/fit/partial_polish.h"
#include "flank/fit/polish.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fit/flat_scene.h"
#include "flank/base/tolerance_budget.h"
#include "flank/example.h"
#include "flank/threads.h"
#include "sanitized.h"

namespace flank::internal {
namespace {

using testing::cylinder;
using testing::standing_blade;
using testing::twisted_blade;
using testing::upright_motion;

constexpr double kTolerance = 0.02, kLift = 16.0;

FlankFitOptions small_options() {
  FlankFitOptions options;
  options.tolerance_mm = kTolerance;
  options.bounds = {2.0, 9.0, 0.5};
  options.sample_share = 1.0 / 15.0;
  return options;
}

/// A tool of radius 4 along the rulings of the twisted blade, `off` away from where it would touch its first ruling.
FitDraft twisted_draft(const Target& target, double lift, double off, bool free_tool) {
  FitDraft draft;
  draft.targets = {&target};
  draft.motions = {upright_motion({.y = 4.0 + off, .z = -1.0, .x_first = -2.0, .x_last = 62.0, .length = 42.0})};
  draft.motions.front().direction =
      testing::straight_rail(Vec3(0.0, -lift / 1200.0, 1.0), Vec3(0.0, 1.03 * lift / 40.0, 1.0), 8);
  draft.tool = free_tool ? RadialFunction::spline(42.0, Eigen::VectorXd::Constant(6, 4.0)) : cylinder(4.0, 42.0);
  draft.free_tool = free_tool;
  return draft;
}

bool on_rim(const Vec3& p) { return std::min({p.x(), 60.0 - p.x(), p.z(), 40.0 - p.z()}) < 1e-9; }

TEST(TargetPoints, SharesInsideSumToOneAndARimPointCountsHalfACell) {
  const auto blade = standing_blade(0.0);
  FitDraft draft;
  draft.targets = {blade.get()};
  const int per_side = 20;
  double inside = 0.0;
  int rim = 0;
  for (const FacePoint& point : target_points(draft, per_side)) {
    EXPECT_NEAR(point.point.y(), 0.0, 1e-12);
    EXPECT_FALSE(point.one_sided());
    if (on_rim(point.point)) {
      ++rim;
      EXPECT_NEAR(point.share, 0.5 / (per_side * per_side), 1e-12);
    } else {
      inside += point.share;
    }
  }
  EXPECT_NEAR(inside, 1.0, 1e-9);
  EXPECT_GE(rim, 4 * per_side);
}

/// Its points count as one target, of which there are as many for each strip as for one alone.
TEST(TargetPoints, ATargetThatStripsShareHasPointsForEachAndSeveralShareByArea) {
  const auto a = standing_blade(0.0);
  const auto b = make_target({testing::quad(Vec3(0, 9, 0), Vec3(20, 9, 0), Vec3(0, 9, 20), Vec3(20, 9, 20), "F1")});
  FitDraft once, four_times, both;
  once.targets = {a.get()};
  four_times.targets = {a.get(), a.get(), a.get(), a.get()};
  both.targets = {a.get(), b.get()};
  const auto inside = [](const FitDraft& draft, int per_side) {
    int count = 0;
    double share = 0.0;
    for (const FacePoint& point : target_points(draft, per_side)) {
      if (on_rim(point.point)) continue;
      ++count;
      share += point.share;
    }
    EXPECT_NEAR(share, 1.0, 1e-9);
    return count;
  };
  EXPECT_EQ(inside(four_times, 12), inside(once, 24));
  double small = 0.0;
  for (const FacePoint& point : target_points(both, 12)) {
    const double x = point.point.x(), z = point.point.z();
    const bool inner = std::min({x, 20.0 - x, z, 20.0 - z}) > 1e-9;
    if (point.point.y() > 5.0 && inner) small += point.share;
  }
  EXPECT_NEAR(small, 400.0 / 2800.0, 1e-9);
}

TEST(TargetPoints, WhatTheBallCannotReachBesideTheHubCountsFromOneSide) {
  const auto blade = standing_blade(0.0);
  const ObstacleField obstacles(testing::only(testing::hub(true)), *blade, 2.0, 0.0);
  FitDraft draft;
  draft.targets = {blade.get()};
  draft.obstacles = {&obstacles};
  int out = 0;
  for (const FacePoint& point : target_points(draft, 15, {5.0, 0.1})) {
    if (on_rim(point.point)) continue;
    EXPECT_EQ(point.one_sided(), point.point.z() < 4.9) << point.point.transpose();
    out += point.one_sided() ? 1 : 0;
  }
  EXPECT_GT(out, 10);
}

FitStage small_stage() {
  FitStage stage = testing::bare_stage();
  stage.fairness = 1e-3;
  stage.transversal_anchor = 1e-2;
  stage.axial_pin = 1e-8;
  stage.tool_coefficients = 8;
  stage.tool_fairness = 1e-6;
  return stage;
}

TEST(RunSwept, LaysAToolThatIsOffOntoThePlane) {
  const auto blade = standing_blade(0.0);
  std::vector<IterationTrace> trace(1);
  const FitDraft draft = twisted_draft(*blade, 0.0, 0.35, false);
  const FitDraft next = run_swept(draft, {}, small_stage(), target_points(draft, 10), &trace);
  ASSERT_GT(trace.size(), 2u);
  EXPECT_NEAR(trace[1].rms_mm, 0.35, 0.01);
  EXPECT_LT(trace.back().rms_mm, 1e-4);
  EXPECT_EQ(next.tool.parameters()[0], 4.0);
  for (const double t : {0.1, 0.5, 0.9}) EXPECT_NEAR(next.motions.front().pose(t).at(20.0).y(), 4.0, 1e-3);
}

TEST(RunSwept, AFreeToolOnATwistedBladeLeavesLessThanACylinder) {
  const auto target = twisted_blade(kLift);
  std::vector<IterationTrace> given, free;
  const FitDraft cylinder_draft = twisted_draft(*target, kLift, 0.0, false);
  const FitDraft spline_draft = twisted_draft(*target, kLift, 0.0, true);
  const FitDraft fixed =
      run_swept(cylinder_draft, {2.0, 9.0, 0.5}, small_stage(), target_points(cylinder_draft, 10), &given);
  const FitDraft next = run_swept(spline_draft, {2.0, 9.0, 0.5}, small_stage(), target_points(spline_draft, 10), &free);
  EXPECT_LT(given.back().cost, given.front().cost);
  EXPECT_LT(free.back().rms_mm, 0.9 * given.back().rms_mm);
  EXPECT_EQ(fixed.tool.parameters()[0], 4.0);
  EXPECT_EQ(next.tool.parameter_count(), 8);
}

TEST(RunConstrained, CutsNothingEvenBetweenItsPoints) {
  if (kSanitized) GTEST_SKIP() << "200 points a side; constrained_test runs the same with fewer";
  const auto target = twisted_blade(kLift);
  const FitDraft next =
      run_constrained(twisted_draft(*target, kLift, 0.0, false), {}, small_stage(), 0.2, {2.0, kTolerance});
  std::vector<SurfaceSample> samples = target->samples(0.37);
  for (const Vec3& point : target->border_points(0.37)) samples.push_back({point, Vec3::UnitY(), 1.0});
  EXPECT_LT(estimate_coverage(samples, next.motions, next.tool, kTolerance, 400).overcut_mm, 1e-4);
}

TEST(SweptPolish, NeverReturnsWorseThanItWasGiven) {
  if (kSanitized) GTEST_SKIP() << "six passes; one pass runs above";
  const auto target = twisted_blade(kLift);
  const FlankFitOptions options = small_options();
  const auto samples = ranking_samples(*target, nullptr, options);
  const Polished before = assess(twisted_draft(*target, kLift, 0.03, true), samples, options);
  std::vector<IterationTrace> trace;
  const Polished after = swept_polish(before, samples, options, &trace);
  EXPECT_GT(after.estimate.score(kTolerance), before.estimate.score(kTolerance) + 0.1) << "there is much to gain";
  EXPECT_FALSE(trace.empty());
  // Its first two passes already tell where it leads.
  const Polished first = first_passes(before, samples, options, nullptr);
  EXPECT_GT(first.estimate.score(kTolerance), before.estimate.score(kTolerance) + 0.1);
  EXPECT_LE(first.estimate.score(kTolerance), after.estimate.score(kTolerance));
  const Polished again = swept_polish(after, samples, options, nullptr);
  EXPECT_GE(again.estimate.score(kTolerance), after.estimate.score(kTolerance));
  // What it says of itself is what is measured.
  const Polished measured = assess(after.draft, samples, options);
  EXPECT_EQ(measured.estimate.at_tolerance, after.estimate.at_tolerance);
  EXPECT_EQ(measured.estimate.overcut_mm, after.estimate.overcut_mm);
}

TEST(PartialPolish, CoversMoreWhereOneStripCannotDoAllAndCutsNothing) {
  constexpr double kTwisted = 30.0;
  const auto target = twisted_blade(kTwisted);
  FlankFitOptions options = small_options();
  options.tolerance_mm = 0.004;
  const auto samples = ranking_samples(*target, nullptr, options);
  const Polished before =
      swept_polish(assess(twisted_draft(*target, kTwisted, 0.0, true), samples, options), samples, options, nullptr);
  ASSERT_LT(before.estimate.at_tolerance, 0.9) << "there must be something to give up";
  ASSERT_GT(before.estimate.at_tolerance, 0.5);
  const Polished after = partial_polish(before, samples, options, nullptr);
  EXPECT_GT(after.estimate.at_tolerance, before.estimate.at_tolerance + 0.02);
  EXPECT_LT(after.estimate.overcut_mm, std::max(options.tolerance_mm, before.estimate.overcut_mm));
  EXPECT_GT(after.estimate.score(options.tolerance_mm), before.estimate.score(options.tolerance_mm));
}

TEST(PartialPolish, LeavesWhatIsCoveredAndWhatIsHopelessAlone) {
  const auto target = twisted_blade(kLift);
  const FlankFitOptions options = small_options();
  const auto samples = ranking_samples(*target, nullptr, options);
  Polished given = assess(twisted_draft(*target, kLift, 0.0, true), samples, options);
  for (const double covered : {0.999, 0.3}) {
    given.estimate.at_tolerance = covered;
    const Polished same = partial_polish(given, samples, options, nullptr);
    EXPECT_EQ(same.draft.motions.front().tip.poles, given.draft.motions.front().tip.poles) << covered;
    EXPECT_EQ(same.draft.tool.parameters(), given.draft.tool.parameters()) << covered;
  }
}

TEST(SweptPolish, AFirmPassLeavesOtherFacesAndASoftOneDoesNotQuite) {
  const auto blade = standing_blade(0.0);
  // A wall across the end of the blade: only the last poses meet it, against all the others that go on.
  const double deep = 4.0 * kTolerance;
  const ObstacleFace wall{
      make_target({testing::quad(Vec3(60, 50, -20), Vec3(60, -50, -20), Vec3(60, 50, 60), Vec3(60, -50, 60), "F3")}),
      true};
  const ObstacleField obstacles(testing::only(wall), *blade, 2.0, kToleranceBudget.others.fit_allowance * kTolerance);
  FitDraft draft = twisted_draft(*blade, 0.0, 0.0, false);
  draft.obstacles = {&obstacles};
  draft.motions = {upright_motion({.y = 4.0, .z = -1.0, .x_first = -2.0, .x_last = 56.0 + deep, .length = 42.0})};
  const auto depth = [](const FitDraft& d) { return flank_gouge(d.motions, d.obstacles, d.tool, {}, 400); };
  ASSERT_NEAR(depth(draft), deep, 1e-6);
  const double soft = depth(pass_at(draft, {}, small_options(), 1.0, 1.0));
  const double firm = depth(pass_at(draft, {}, small_options(), 100.0, 1.0));
  EXPECT_LT(soft, deep);
  EXPECT_LT(firm, 0.5 * (soft + kToleranceBudget.others.fit_allowance * kTolerance)) << soft;
  EXPECT_LE(firm, kToleranceBudget.fit.clean * kTolerance) << soft;
}

TEST(SweptPolish, APassIsTheSameForOneAndThreeThreads) {
  const auto target = twisted_blade(kLift);
  const FitDraft draft = twisted_draft(*target, kLift, 0.1, true);
  FitStage stage = small_stage();
  stage.iterations = 3;
  std::vector<FitDraft> results;
  for (const int threads : {1, 3}) {
    set_thread_count(threads);
    results.push_back(run_swept(draft, {2.0, 9.0, 0.5}, stage, target_points(draft, 12), nullptr));
  }
  set_thread_count(0);
  EXPECT_EQ(results[0].motions.front().tip.poles, results[1].motions.front().tip.poles);
  EXPECT_EQ(results[0].motions.front().direction.poles, results[1].motions.front().direction.poles);
  EXPECT_EQ(results[0].tool.parameters(), results[1].tool.parameters());
}

TEST(WithoutOvercut, LeavesFreeToolsAndToolsThatCutNothingAlone) {
  const auto target = twisted_blade(kLift);
  const FlankFitOptions options = small_options();
  const auto samples = ranking_samples(*target, nullptr, options);
  const Polished sunken = assess(twisted_draft(*target, kLift, -0.1, true), samples, options);
  ASSERT_GT(sunken.estimate.overcut_mm, 0.05);
  EXPECT_EQ(without_overcut(sunken, samples, options).draft.motions.front().tip.poles,
            sunken.draft.motions.front().tip.poles);
  const Polished lifted = assess(twisted_draft(*target, kLift, 0.5, false), samples, options);
  ASSERT_EQ(lifted.estimate.overcut_mm, 0.0);
  EXPECT_EQ(without_overcut(lifted, samples, options).draft.motions.front().tip.poles,
            lifted.draft.motions.front().tip.poles);
  // An exact fit may keep a tenth of the tolerance.
  Polished exact = lifted;
  exact.exact = true;
  exact.estimate.overcut_mm = 0.09 * kTolerance;
  EXPECT_EQ(without_overcut(exact, samples, options).draft.motions.front().tip.poles,
            exact.draft.motions.front().tip.poles);
}

TEST(WithoutOvercut, AGivenToolIsLiftedAtThePriceOfMaterialLeft) {
  if (kSanitized) GTEST_SKIP() << "200 points a side; constrained_test runs the same with fewer";
  const auto target = twisted_blade(kLift);
  const FlankFitOptions options = small_options();
  const auto samples = ranking_samples(*target, nullptr, options);
  const FitDraft draft = twisted_draft(*target, kLift, 0.0, false);
  const Polished before =
      assess(run_swept(draft, {}, small_stage(), target_points(draft, 12), nullptr), samples, options);
  ASSERT_GT(before.estimate.overcut_mm, 0.2 * kTolerance);
  const Polished after = without_overcut(before, samples, options);
  EXPECT_LT(after.estimate.overcut_mm, 0.02 * before.estimate.overcut_mm);
  EXPECT_LT(after.estimate.undercut_mm, 0.15);
  EXPECT_EQ(after.draft.tool.parameters()[0], 4.0);
}

TEST(LastDigits, AreFoundOnAnEnvelope) {
  const Example example = make_example("envelope-barrel-2");
  const auto target = make_target(std::vector<Face>{example.faces.front()});
  const double size = target->diagonal();
  FlankFitOptions options = small_options();
  options.bounds = {1.0, 100.0, 0.95};
  options.tolerance_mm = 5e-5 * size;
  const auto samples = ranking_samples(*target, nullptr, options);
  FitDraft draft;
  draft.targets = {target.get()};
  draft.motions = {example.truth->motions.front()};
  const double length = draft.motions.front().axis_length;
  std::vector<Vec2> radii;
  for (int j = 0; j <= 200; ++j) {
    const double s = length * j / 200.0;
    radii.emplace_back(s, example.truth->tool.radial.at(s).r + 2e-5 * size * std::sin(9.0 * s / length));
  }
  draft.tool = RadialFunction::spline_through(length, radii, 16);
  draft.free_tool = true;
  const Polished rough = assess(draft, samples, options);
  ASSERT_GT(rough.estimate.rms_mm, 5e-6 * size);
  const Polished fine = refine_exact_envelope(rough, samples, options, nullptr);
  EXPECT_TRUE(fine.exact);
  EXPECT_LT(fine.estimate.rms_mm, 0.2 * rough.estimate.rms_mm);
  EXPECT_LE(fine.estimate.overcut_mm, std::max(rough.estimate.overcut_mm, 2e-6 * size));
  EXPECT_GE(fine.estimate.at_tolerance, rough.estimate.at_tolerance);
}

/// A close look lifts a given tool out of all overcut, by what a sphere may be deeper between two points.
TEST(LastDigits, OfAnEnvelopeAreFoundAgainByAGivenToolThatWasLifted) {
  const Example example = make_example("envelope-barrel-1");
  const auto target = make_target(std::vector<Face>{example.faces.front()});
  const double size = target->diagonal();
  FlankFitOptions options = small_options();
  options.tolerance_mm = 1e-4 * size;
  const auto samples = ranking_samples(*target, nullptr, options);
  FitDraft draft;
  draft.targets = {target.get()};
  draft.motions = {example.truth->motions.front()};
  draft.tool = example.truth->tool.radial;
  const Vec3 middle = draft.motions.front().pose(0.5).at(0.5 * draft.motions.front().axis_length);
  draft.motions.front().tip.poles.colwise() += Vec3(6e-5 * size * target->closest(middle).normal);
  const Polished lifted = assess(draft, samples, options);
  ASSERT_GT(lifted.estimate.rms_mm, 4e-5 * size);
  const Polished fine = refine_exact_envelope(lifted, samples, options, nullptr);
  EXPECT_TRUE(fine.exact);
  EXPECT_LT(fine.estimate.rms_mm, 5e-7 * size);
  EXPECT_LT(measured_closely(fine.draft, options).estimate.turn, 1.0);
}

TEST(LastDigits, LeaveWhatIsNoEnvelopeAndToolsThatAreGiven) {
  const auto target = twisted_blade(kLift);
  const FlankFitOptions options = small_options();
  const auto samples = ranking_samples(*target, nullptr, options);
  for (const bool free_tool : {true, false}) {
    const Polished start = assess(twisted_draft(*target, kLift, 0.0, free_tool), samples, options);
    const Polished same = refine_exact_envelope(start, samples, options, nullptr);
    EXPECT_FALSE(same.exact);
    EXPECT_EQ(same.draft.motions.front().tip.poles, start.draft.motions.front().tip.poles);
  }
}

}  // namespace
}  // namespace flank::internal
