// From a draft to a result, step by step: the samples that rank, the first draft, the passes, what is shifted against
// overcut, the verdict. Scenes are flat or slightly twisted, so that a second is enough.
#include "flank/fit/polish.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fit/flat_scene.h"
#include "flank/fit/coverage.h"
#include "flank/fit/partial_polish.h"
#include "flank/threads.h"
#include "flank/tool.h"
#include "sanitized.h"
#include "seed/exact_targets.h"

namespace flank::internal {
namespace {

/// |c| of the motions as they will be written.
double written_c_of(const FitDraft& draft, double tolerance_mm) {
  CoverageEstimate estimate;
  FlankFitOptions options;
  options.tolerance_mm = tolerance_mm;
  measure_written(draft, options, estimate);
  return estimate.largest_c;
}

using testing::cylinder;
using testing::standing_blade;
using testing::twisted_blade;
using testing::Upright;
using testing::upright_motion;

constexpr double kTolerance = 0.02;

FlankFitOptions small_options() {
  FlankFitOptions options;
  options.tolerance_mm = kTolerance;
  options.bounds = {2.0, 9.0, 0.5};
  options.sample_share = 1.0 / 15.0;
  return options;
}

/// Past all borders of the blade.
Upright whole_blade(double y) { return {.y = y, .z = -1.0, .x_first = -3.0, .x_last = 63.0, .length = 42.0}; }

FitDraft draft_of(const Target& target, const RuledMotion& motion, const RadialFunction& tool, bool free_tool) {
  FitDraft draft;
  draft.targets = {&target};
  draft.motions = {motion};
  draft.tool = tool;
  draft.free_tool = free_tool;
  return draft;
}

RadialFunction even_spline(double radius, double length = 42.0) {
  return RadialFunction::spline(length, Eigen::VectorXd::Constant(6, radius));
}

TEST(Polish, TheRobustScaleIsFourTolerancesOrAThousandthOfTheTarget) {
  const auto blade = standing_blade(0.0);
  FlankFitOptions options = small_options();
  EXPECT_DOUBLE_EQ(robust_scale(*blade, options), 4.0 * kTolerance);
  options.tolerance_mm = 1e-4;
  EXPECT_DOUBLE_EQ(robust_scale(*blade, options), 1e-3 * blade->diagonal());
}

TEST(Polish, TheReachIsThatOfTheBallGivenElseOfTheSmallestRadius) {
  FlankFitOptions options = small_options();
  EXPECT_EQ(reach_radius(options), 2.0);
  options.reach_radius_mm = 3.5;
  EXPECT_EQ(reach_radius(options), 3.5);
}

TEST(Polish, RankingSamplesStandForTheWholeAreaAndTheRimForNone) {
  const auto blade = standing_blade(0.0);
  const auto samples = ranking_samples(*blade, nullptr, small_options());
  double area = 0.0;
  int rim = 0;
  for (const SurfaceSample& sample : samples) {
    area += sample.area;
    const Vec3& p = sample.point;
    const bool border = std::min({p.x(), 60.0 - p.x(), p.z(), 40.0 - p.z()}) < 1e-9;
    EXPECT_EQ(border, sample.area == 0.0) << p.transpose();
    rim += border ? 1 : 0;
  }
  EXPECT_NEAR(area, 2400.0, 1e-6);
  EXPECT_GE(rim, static_cast<int>(200.0 * 15.0 / std::sqrt(2400.0)));
}

TEST(Polish, RankingSamplesHoldWatchedPlacesWithoutArea) {
  const auto blade = standing_blade(0.0);
  FlankFitOptions options = small_options();
  const std::size_t count = ranking_samples(*blade, nullptr, options).size();
  options.extra_overcut_points = {Vec3(1.0, 2.0, 3.0)};
  const auto samples = ranking_samples(*blade, nullptr, options);
  ASSERT_EQ(samples.size(), count + 1);
  EXPECT_EQ(samples.back().point, options.extra_overcut_points.front());
  EXPECT_EQ(samples.back().area, 0.0);
}

TEST(Polish, RankingSamplesOutOfReachHaveNoArea) {
  const auto blade = standing_blade(0.0);
  const ObstacleField obstacles(testing::only(testing::hub(true)), *blade, 2.0, 0.0);
  FlankFitOptions options = small_options();
  options.reach_radius_mm = 6.0;  // its ball touches the blade down to z = 6 less the tolerance
  for (const SurfaceSample& sample : ranking_samples(*blade, &obstacles, options)) {
    const double z = sample.point.z();
    const bool rim = std::min({sample.point.x(), 60.0 - sample.point.x(), z, 40.0 - z}) < 1e-9;
    EXPECT_EQ(sample.area > 0.0, !rim && z > 6.0 - kTolerance) << sample.point.transpose();
  }
}

TEST(Polish, TheFirstDraftOfAFreeToolIsItsMeanDistance) {
  const auto blade = standing_blade(0.0);
  RuledMotion leaning = upright_motion({.y = 4.0});
  leaning.direction.poles.colwise() = Vec3(0.0, 0.1, std::sqrt(0.99));
  const FitDraft draft = make_draft({{blade.get(), leaning}}, {}, small_options());
  EXPECT_TRUE(draft.free_tool);
  EXPECT_EQ(draft.tool.axis_length(), 30.0);
  for (int s = 0; s <= 30; s += 3) EXPECT_NEAR(draft.tool.at(s).r, 4.0 + 0.1 * s, 1e-6);
  const FitDraft far = make_draft({{blade.get(), upright_motion({.y = 30.0})}}, {}, small_options());
  EXPECT_NEAR(far.tool.at(15.0).r, 9.0, 1e-9) << "within the bounds";
}

TEST(Polish, TheFirstDraftOfAGivenFamilyIsMadeForTheLengthAndTheRadiusAtMidLength) {
  const auto blade = standing_blade(0.0);
  ToolModel model;
  double length = 0.0, radius = 0.0;
  model.make = [&](double l, double r) {
    length = l;
    radius = r;
    return cylinder(r, l);
  };
  model.free_parameters = {0};
  const FitDraft draft = make_draft({{blade.get(), upright_motion({.y = 4.5})}}, model, small_options());
  EXPECT_EQ(length, 30.0);
  EXPECT_NEAR(radius, 4.5, 1e-9);
  EXPECT_FALSE(draft.free_tool);
  EXPECT_EQ(draft.free_parameters, std::vector<int>{0});
  EXPECT_EQ(draft.tool.family(), ToolFamily::kCylinder);
}

TEST(Polish, AssessingClampsAFreeToolAndMeasuresTheClampedOne) {
  const auto blade = standing_blade(0.0);
  const FlankFitOptions options = small_options();
  const auto samples = ranking_samples(*blade, nullptr, options);
  const RuledMotion motion = upright_motion(whole_blade(9.0));
  const Polished held = assess(draft_of(*blade, motion, even_spline(9.5), true), samples, options);
  EXPECT_EQ(held.draft.tool.parameters().maxCoeff(), 9.0);
  EXPECT_EQ(held.estimate.at_tolerance, 1.0);
  EXPECT_LT(held.estimate.overcut_mm, 1e-6);
  const Polished given = assess(draft_of(*blade, motion, cylinder(9.5, 42.0), false), samples, options);
  EXPECT_NEAR(given.estimate.overcut_mm, 0.5, 1e-6);
}

TEST(Polish, AnExactTargetIsRecognisedAndMetToItsLastDigits) {
  const auto blade = standing_blade(0.0);
  const FlankFitOptions options = small_options();
  const auto samples = ranking_samples(*blade, nullptr, options);
  std::vector<IterationTrace> trace;
  const Polished result =
      polish(draft_of(*blade, upright_motion(whole_blade(5.3)), cylinder(5.0, 42.0), false), samples, options, &trace);
  EXPECT_TRUE(result.exact);
  EXPECT_EQ(result.estimate.at_tolerance, 1.0);
  EXPECT_LT(result.estimate.overcut_mm, 1e-4);
  EXPECT_LT(result.estimate.undercut_mm, 1e-4);
  ASSERT_FALSE(trace.empty());
  EXPECT_NEAR(trace.front().rms_mm, 0.3, 1e-3);
  EXPECT_LT(trace.back().rms_mm, 1e-5);
}

/// A twisted blade and a tool of this radius, its axis along the rulings and `off` away from where it would touch the
/// first one, longer than all of them.
FitDraft twisted_draft(const Target& target, double lift, double radius, double off, bool free_tool) {
  const double length = std::hypot(40.0, lift) + 3.0;
  RuledMotion motion =
      upright_motion({.y = radius + off, .z = -1.0, .x_first = -3.0, .x_last = 63.0, .length = length});
  motion.direction = testing::straight_rail(Vec3(0.0, -0.05 * lift / 40.0, 1.0), Vec3(0.0, 1.05 * lift / 40.0, 1.0), 8);
  return draft_of(target, motion, free_tool ? even_spline(radius, length) : cylinder(radius, length), free_tool);
}

void expect_within(const RadialFunction& tool, const RadiusBounds& bounds, double slack) {
  for (int j = 0; j <= 100; ++j) {
    const RadialJet jet = tool.at(tool.axis_length() * j / 100.0);
    EXPECT_GE(jet.r, bounds.smallest - slack);
    EXPECT_LE(jet.r, bounds.largest + slack);
    EXPECT_LE(std::abs(jet.d1), bounds.steepest + slack);
  }
}

TEST(Polish, NeverReturnsWorseThanItsDraft) {
  // Twisted so much that no cylinder of this size has the blade for an envelope.
  constexpr double kLift = 32.0;
  const auto target = twisted_blade(kLift);
  FlankFitOptions options = small_options();
  options.bounds = {15.7, 16.3, 0.05};
  const auto samples = ranking_samples(*target, nullptr, options);
  FitDraft draft = twisted_draft(*target, kLift, 16.0, 0.0, false);
  draft.free_parameters = {0};
  Polished last = assess(draft, samples, options);
  for (int k = 0; k < (kSanitized ? 1 : 3); ++k) {
    Polished next = polish(last.draft, samples, options, nullptr);
    EXPECT_FALSE(next.exact);
    EXPECT_GE(next.estimate.score(kTolerance), last.estimate.score(kTolerance)) << k;
    expect_within(next.draft.tool, options.bounds, 2e-3);  // a family is held by one-sided terms
    last = std::move(next);
  }
  EXPECT_GT(last.estimate.at_tolerance, 0.9);
}

TEST(Polish, AFreeToolStaysWithinItsBounds) {
  constexpr double kLift = 16.0;
  const auto target = twisted_blade(kLift);
  FlankFitOptions options = small_options();
  options.bounds = {3.95, 4.05, 0.2};
  const auto samples = ranking_samples(*target, nullptr, options);
  for (const double off : {0.02, -0.2}) {
    const Polished result = polish(twisted_draft(*target, kLift, 4.0, off, true), samples, options, nullptr);
    expect_within(result.draft.tool, options.bounds, 1e-12);
    EXPECT_GT(result.estimate.at_tolerance, 0.98) << off;
    if (kSanitized) break;
  }
}

TEST(Polish, ABentTargetIsNotFollowedBeyondTheSteepestSlope) {
  const testing::ExactTarget exact = testing::barrel_target();
  const FitDraft draft = draft_of(*exact.target, exact.motion, even_spline(5.6, 40.0), true);
  FitStage stage = quick_stage(1.0);
  stage.iterations = 60;
  stage.step_tolerance = 1e-9;
  const auto steepest = [&](double bound) {
    const RadialFunction tool = run_stage(draft, {2.0, 9.0, bound}, stage).tool;
    double most = 0.0;
    for (int j = 0; j <= 80; ++j) most = std::max(most, std::abs(tool.at(0.5 * j).d1));
    return most;
  };
  EXPECT_GT(steepest(0.5), 0.04) << "this is what the barrel asks for";
  EXPECT_LT(steepest(0.02), 0.02 + 5e-4);
}

TEST(Polish, IsTheSameForOneAndThreeThreads) {
  const auto target = twisted_blade(16.0);
  const FlankFitOptions options = small_options();
  const auto samples = ranking_samples(*target, nullptr, options);
  const FitDraft draft = twisted_draft(*target, 16.0, 4.0, 0.2, true);
  std::vector<Polished> results;
  for (const int threads : {1, 3}) {
    set_thread_count(threads);
    results.push_back(polish(draft, samples, options, nullptr));
  }
  set_thread_count(0);
  EXPECT_EQ(results[0].draft.motions.front().tip.poles, results[1].draft.motions.front().tip.poles);
  EXPECT_EQ(results[0].draft.tool.parameters(), results[1].draft.tool.parameters());
  EXPECT_EQ(results[0].estimate.rms_mm, results[1].estimate.rms_mm);
}

/// A free tool on the plane that cuts by `overcut`.
Polished on_plane(const Target& blade, double overcut, bool free_tool, const std::vector<SurfaceSample>& samples,
                  const FlankFitOptions& options) {
  const RuledMotion motion = upright_motion(whole_blade(5.0 - overcut));
  return assess(draft_of(blade, motion, free_tool ? even_spline(5.0) : cylinder(5.0, 42.0), free_tool), samples,
                options);
}

TEST(Polish, AnExactFitIsShiftedToATenthOfTheToleranceAndNoFurther) {
  const auto blade = standing_blade(0.0);
  const FlankFitOptions options = small_options();
  const auto samples = ranking_samples(*blade, nullptr, options);
  Polished exact = on_plane(*blade, 0.6 * kTolerance, true, samples, options);
  exact.exact = true;
  const Polished lower = last_passes(exact, samples, options, nullptr);
  EXPECT_TRUE(lower.exact);
  EXPECT_NEAR(lower.estimate.overcut_mm, 0.1 * kTolerance, 1e-6);
  EXPECT_EQ(lower.draft.motions.front().tip.poles, exact.draft.motions.front().tip.poles);
  Polished fine = on_plane(*blade, 0.05 * kTolerance, true, samples, options);
  fine.exact = true;
  EXPECT_EQ(last_passes(fine, samples, options, nullptr).draft.tool.parameters(), fine.draft.tool.parameters());
  Polished given = on_plane(*blade, 0.6 * kTolerance, false, samples, options);
  given.exact = true;
  EXPECT_EQ(last_passes(given, samples, options, nullptr).draft.tool.parameters()[0], 5.0);
}

TEST(Polish, AnExactFitThatCutsDeepIsNotShiftedOffTheFace) {
  if (kSanitized) GTEST_SKIP() << "every pass of the swept polish";
  const auto blade = standing_blade(0.0);
  const FlankFitOptions options = small_options();
  const auto samples = ranking_samples(*blade, nullptr, options);
  // Too thick at the tip alone; elsewhere it lies on the blade.
  FitDraft draft = draft_of(*blade, upright_motion(whole_blade(5.0)), even_spline(5.0), true);
  draft.tool = draft.tool.with_parameters((Eigen::VectorXd(6) << 5.2, 5.0, 5.0, 5.0, 5.0, 5.0).finished());
  Polished deep = assess(draft, samples, options);
  deep.exact = true;
  ASSERT_GT(deep.estimate.overcut_mm, 2.0 * kTolerance);
  const Polished after = last_passes(deep, samples, options, nullptr);
  EXPECT_GT(after.estimate.score(kTolerance), deep.estimate.score(kTolerance));
  EXPECT_GT(after.estimate.at_tolerance, 0.99);
  EXPECT_LE(after.estimate.overcut_mm, kTolerance);
}

TEST(Polish, SettlingTakesAFreeToolBackBelowTheTolerance) {
  const auto blade = standing_blade(0.0);
  const FlankFitOptions options = small_options();
  const auto samples = ranking_samples(*blade, nullptr, options);
  for (const double tolerances : {0.5, 0.97}) {
    const Polished before = on_plane(*blade, tolerances * kTolerance, true, samples, options);
    const Polished after = repair_closely(before, options);
    EXPECT_LE(after.estimate.overcut_mm, kTolerance) << tolerances;
    EXPECT_EQ(after.estimate.at_tolerance, 1.0) << tolerances;
    const double shift = before.draft.tool.parameters()[0] - after.draft.tool.parameters()[0];
    const double least = tolerances < 0.92 ? 0.0 : (tolerances - 0.95) * kTolerance - 1e-6;
    EXPECT_GE(shift, least) << tolerances;
    EXPECT_EQ(shift > 0.0, tolerances > 0.92) << "only if it must";
  }
}

TEST(Polish, SettlingMakesAToolOfWhatIsNone) {
  const auto blade = standing_blade(0.0);
  const FlankFitOptions options = small_options();
  const auto samples = ranking_samples(*blade, nullptr, options);
  // A valley between the samples of the passes, so narrow that its spheres stick out of each other.
  Eigen::VectorXd radii = Eigen::VectorXd::Constant(160, 5.0);
  radii[80] -= 0.8 * kTolerance;
  FitDraft draft = draft_of(*blade, upright_motion(whole_blade(5.0)), even_spline(5.0), true);
  draft.tool = RadialFunction::spline(draft.tool.axis_length(), radii);
  ASSERT_FALSE(check_legitimacy(draft.tool).legitimate);
  const Polished after = repair_closely(assess(draft, samples, options), options);
  EXPECT_TRUE(after.estimate.legitimate);
  EXPECT_TRUE(check_legitimacy(after.draft.tool).legitimate);
  EXPECT_EQ(after.estimate.at_tolerance, 1.0);
  EXPECT_EQ(after.draft.motions.front().tip.poles, draft.motions.front().tip.poles) << "smoothed, not fitted again";
}

TEST(Polish, WhatTheLastLookFindsTooDeepIsLedOut) {
  const auto blade = standing_blade(0.0);
  const FlankFitOptions options = small_options();
  const auto samples = ranking_samples(*blade, nullptr, options);
  for (const bool free : {true, false}) {
    const Polished before = on_plane(*blade, 1.7 * kTolerance, free, samples, options);
    ASSERT_GT(before.estimate.overcut_mm, kTolerance);
    const Polished after = repair_closely(before, options);
    EXPECT_LE(after.estimate.overcut_mm, kTolerance) << free;
    EXPECT_EQ(after.estimate.at_tolerance, 1.0) << free;
  }
  // Far too deep is no matter of a last pass.
  const Polished lost = on_plane(*blade, 20.0 * kTolerance, false, samples, options);
  EXPECT_NEAR(repair_closely(lost, options).estimate.overcut_mm, 20.0 * kTolerance, 1e-6);
}

/// A ridge as narrow as a point, between all samples: who finds it says so.
TEST(Polish, ACutThatSomebodyElseFoundIsMended) {
  if (kSanitized) GTEST_SKIP() << "passes of 2,500 points";
  const auto blade = standing_blade(0.0);
  FlankFitOptions options = small_options();
  options.extra_overcut_points = {Vec3(30.1, 1.6 * kTolerance, 20.1)};
  FlankFitResult found;
  found.motions = {upright_motion(whole_blade(5.0))};
  found.tool = even_spline(5.0);
  found.notes = {"kept"};
  const std::vector<FitTask> tasks{{blade.get(), found.motions.front()}};
  const auto mended = mend_fit(tasks, found, {}, options);
  ASSERT_TRUE(mended);
  EXPECT_LE(mended->after.overcut_mm, kTolerance);
  EXPECT_EQ(mended->after.at_tolerance, 1.0);
  EXPECT_EQ(mended->notes, found.notes);
  const std::vector<SurfaceSample> ridge{{options.extra_overcut_points.front(), Vec3::UnitY(), 1.0}};
  EXPECT_LE(estimate_coverage(ridge, mended->motions, mended->tool, kTolerance, 600).overcut_mm, kTolerance);
  options.extra_overcut_points = {Vec3(30.1, 0.5 * kTolerance, 20.1)};
  EXPECT_FALSE(mend_fit(tasks, found, {}, options)) << "nothing is to be mended";
}

constexpr double kLoose = 0.6;  ///< mm: a tolerance that does not mind the cusp of cusped_draft

FlankFitOptions loose_options() {
  FlankFitOptions options = small_options();
  options.bounds = {2.0, 30.0, 0.5};
  options.tolerance_mm = kLoose;
  return options;
}

/// A cone that touches the plane along a line, on rails that go along it but for one of their control points: there they turn
/// up and down again, within 3 mm where there are 48 of them.
FitDraft cusped_draft(const Target& blade, int control_points, int cusp) {
  constexpr double kSlope = 0.4, kTip = 3.0, kLong = 60.0, kCusp = 20.0, kLift = 0.9;
  RuledMotion motion = upright_motion(
      {.y = kTip, .z = -10.0, .x_first = -3.0, .x_last = 63.0, .length = kLong, .control_points = control_points});
  const Vec3 axis(0.0, kSlope, std::sqrt(1.0 - kSlope * kSlope));
  for (int k = 0; k < control_points; ++k) motion.direction.poles.col(k) = axis;
  motion.tip.poles.col(cusp) += Vec3(0.0, kLift, kCusp);
  std::vector<Vec2> line;
  for (int j = 0; j <= 24; ++j) line.emplace_back(kLong * j / 24.0, kTip + kSlope * kLong * j / 24.0);
  return draft_of(blade, motion, RadialFunction::spline_through(kLong, line, 6), true);
}

TEST(Polish, SettlingTakesACuspOutOfAMotionThatPlungesThere) {
  if (kSanitized) GTEST_SKIP() << "a pass of 48 control points";
  const auto blade = standing_blade(0.0);
  const FlankFitOptions options = loose_options();
  const std::vector<SurfaceSample> samples = ranking_samples(*blade, nullptr, options);
  const Polished plunging = assess(cusped_draft(*blade, 48, 24), samples, options);
  ASSERT_GT(plunging.estimate.largest_c, 1.0);
  ASSERT_GT(plunging.estimate.at_tolerance, 0.99);
  const Polished steady = repair_closely(plunging, options);
  EXPECT_LT(steady.estimate.largest_c, 1.0);
  EXPECT_GT(steady.estimate.at_tolerance, 0.99);
  EXPECT_LE(steady.estimate.overcut_mm, kLoose);
}

TEST(Polish, AFirmPassPlungesLess) {
  if (kSanitized) GTEST_SKIP() << "passes of 48 control points";
  const auto blade = standing_blade(0.0);
  const FlankFitOptions options = loose_options();
  const FitDraft draft = cusped_draft(*blade, 48, 24);
  const auto c_after = [&](double steadiness) {
    return written_c_of(pass_at(draft, {}, options, 1.0, 1.0, steadiness), kLoose);
  };
  const double loose = c_after(1.0), firm = c_after(1000.0);
  EXPECT_GT(loose, 0.9) << "other passes leave it near plunging";
  EXPECT_LT(firm, 0.8 * loose);
}

TEST(Polish, TheWrittenPathSeesACuspBetweenAnyEvenPoses) {
  const auto blade = standing_blade(0.0);
  // The turn takes less than a thousandth of the way, in the middle between two of 640 poses.
  constexpr int kPoles = 6400;
  const FitDraft draft = cusped_draft(*blade, kPoles, kPoles / 2 + kPoles / 1280);
  ASSERT_LT(touching_c(draft, kLoose, 640), 1.0);
  EXPECT_GT(written_c_of(draft, kLoose), 1.0);
  FitDraft none = draft;
  none.motions.front().direction.poles.setZero();
  EXPECT_EQ(written_c_of(none, kLoose), std::numeric_limits<double>::infinity());
}

TEST(Polish, SettlingSeesACuspBetweenThePosesThatRank) {
  const auto blade = standing_blade(0.0);
  const FlankFitOptions options = loose_options();
  // The turn takes a four-hundredth of the way, in the middle between two of 160 poses.
  constexpr int kPoles = 1600;
  const FitDraft draft = cusped_draft(*blade, kPoles, kPoles / 2 + kPoles / 320);
  const Polished ranked = assess(draft, ranking_samples(*blade, nullptr, options), options);
  ASSERT_LT(ranked.estimate.largest_c, 1.0);
  constexpr int kOften = 8 * kRankingPoses;
  ASSERT_GT(touching_c(draft, kLoose, kOften), 1.0);
  const Polished steady = repair_closely(ranked, options);
  EXPECT_LT(touching_c(steady.draft, kLoose, kOften), 1.0);
}

TEST(Polish, TheVerdictAsksForCoverageOvercutAndGouge) {
  const auto blade = standing_blade(0.0);
  const FlankFitOptions options = small_options();
  const auto samples = ranking_samples(*blade, nullptr, options);
  Polished good = on_plane(*blade, 0.0, true, samples, options);
  const auto status = [&](const Polished& polished) { return make_result(polished, options, {}).status; };
  EXPECT_EQ(status(good), FitStatus::kWithinTolerance);
  Polished worse = good;
  worse.estimate.at_tolerance = 0.989;
  EXPECT_EQ(status(worse), FitStatus::kPartial);
  worse = good;
  worse.estimate.overcut_mm = 1.01 * kTolerance;
  EXPECT_EQ(status(worse), FitStatus::kPartial);
  worse = good;
  worse.estimate.gouge_mm = 1.01 * kTolerance;
  EXPECT_EQ(status(worse), FitStatus::kPartial);
  FlankFitResult started;
  started.candidates = 7;
  const FlankFitResult result = make_result(good, options, started);
  EXPECT_EQ(result.candidates, 7) << "what was known before stays";
  EXPECT_EQ(result.motions.size(), 1u);
  EXPECT_LT(result.residuals.largest_mm, 1e-9);
  EXPECT_NE(result.message.find("estimate: 100.00 % finished at 0.02 mm"), std::string::npos) << result.message;
}

}  // namespace
}  // namespace flank::internal
