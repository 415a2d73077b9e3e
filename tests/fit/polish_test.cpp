// From a draft to a result, step by step: the samples that rank, the first draft, the passes, what is shifted against
// overcut, the verdict. Scenes are flat or slightly twisted, so that a second is enough.
#include "flank/fit/polish.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fit/flat_scene.h"
#include "flank/base/parallel.h"
#include "sanitized.h"
#include "seed/exact_targets.h"

namespace flank::internal {
namespace {

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

TEST(Polish, RankingSamplesOutOfReachHaveNoArea) {
  const auto blade = standing_blade(0.0);
  const FlankChecks checks(testing::only(testing::hub(true)), *blade, 2.0, 0.0);
  FlankFitOptions options = small_options();
  options.reach_radius_mm = 6.0;  // its ball touches the blade down to z = 6 less the tolerance
  for (const SurfaceSample& sample : ranking_samples(*blade, &checks, options)) {
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

/// Drafts before the twisted blade: some good, some off.
std::vector<FitDraft> twisted_drafts(const Target& target, double lift) {
  std::vector<FitDraft> drafts;
  for (const double off : {0.0, 0.02, 0.4}) {
    RuledMotion motion = upright_motion(whole_blade(4.0 + off));
    motion.direction =
        testing::straight_rail(Vec3(0.0, -0.05 * lift / 40.0, 1.0), Vec3(0.0, 1.05 * lift / 40.0, 1.0), 8);
    drafts.push_back(draft_of(target, motion, even_spline(4.0), true));
  }
  return drafts;
}

TEST(Polish, NeverReturnsWorseThanItsDraftAndKeepsTheBoundsOfAFreeTool) {
  constexpr double kLift = 40.0;  // so much that no such tool has it for an envelope
  const auto target = twisted_blade(kLift);
  FlankFitOptions options = small_options();
  options.bounds = {3.9, 4.1, 0.2};
  const auto samples = ranking_samples(*target, nullptr, options);
  std::vector<FitDraft> drafts = twisted_drafts(*target, kLift);
  if (kSanitized) drafts.resize(1);
  for (const FitDraft& draft : drafts) {
    const Polished before = assess(draft, samples, options), after = polish(draft, samples, options, nullptr);
    EXPECT_GE(after.estimate.score(kTolerance), before.estimate.score(kTolerance));
    EXPECT_FALSE(after.exact);
    EXPECT_GT(after.estimate.at_tolerance, 0.5);
    for (int j = 0; j <= 84; ++j) {
      const RadialJet jet = after.draft.tool.at(0.5 * j);
      EXPECT_GE(jet.r, 3.9 - 1e-12);
      EXPECT_LE(jet.r, 4.1 + 1e-12);
      EXPECT_LE(std::abs(jet.d1), 0.2);
    }
    // Again from its own result: no worse than that, either.
    const Polished again = polish(after.draft, samples, options, nullptr);
    EXPECT_GE(again.estimate.score(kTolerance), after.estimate.score(kTolerance));
    if (kSanitized) break;
  }
}

TEST(Polish, ABentTargetIsNotFollowedBeyondTheSteepestSlope) {
  const testing::ExactTarget exact = testing::barrel_target();  // r' falls by 36 / 160 from s = 2 to s = 38
  RadiusBounds bounds{2.0, 9.0, 0.5};
  const FitDraft draft = draft_of(*exact.target, exact.motion, even_spline(5.6, 40.0), true);
  const RadialFunction open = run_stage(draft, bounds, quick_stage(1.0)).tool;
  EXPECT_NEAR(open.at(38.0).d1 - open.at(2.0).d1, -36.0 / 160.0, 0.02);
  bounds.steepest = 0.05;
  const RadialFunction held = run_stage(draft, bounds, quick_stage(1.0)).tool;
  for (int j = 0; j <= 40; ++j) EXPECT_LT(std::abs(held.at(j).d1), 0.05 + 2e-3) << j;
}

TEST(Polish, IsTheSameForOneAndThreeThreads) {
  const auto target = twisted_blade(16.0);
  const FlankFitOptions options = small_options();
  const auto samples = ranking_samples(*target, nullptr, options);
  const FitDraft draft = twisted_drafts(*target, 16.0).back();
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

TEST(Polish, SettlingTakesAFreeToolBackBelowTheTolerance) {
  const auto blade = standing_blade(0.0);
  const FlankFitOptions options = small_options();
  const auto samples = ranking_samples(*blade, nullptr, options);
  for (const double tolerances : {0.5, 0.97, 1.7}) {
    const Polished before = on_plane(*blade, tolerances * kTolerance, true, samples, options);
    const Polished after = settled(before, options);
    EXPECT_LE(after.estimate.overcut_mm, kTolerance) << tolerances;
    EXPECT_EQ(after.estimate.at_tolerance, 1.0) << tolerances;
    const double shift = before.draft.tool.parameters()[0] - after.draft.tool.parameters()[0];
    const double least = tolerances < 0.94 ? 0.0 : (tolerances - 0.95) * kTolerance - 1e-6;
    EXPECT_GE(shift, least) << tolerances;
    EXPECT_EQ(shift > 0.0, tolerances > 0.94) << "only if it must";
  }
  const Polished given = on_plane(*blade, 1.7 * kTolerance, false, samples, options);
  EXPECT_NEAR(settled(given, options).estimate.overcut_mm, 1.7 * kTolerance, 1e-6);
}

TEST(Polish, TheVerdictAsksForCoverageOvercutAndGouge) {
  const auto blade = standing_blade(0.0);
  const FlankFitOptions options = small_options();
  const auto samples = ranking_samples(*blade, nullptr, options);
  Polished good = on_plane(*blade, 0.0, true, samples, options);
  const auto status = [&](const Polished& polished) { return finish(polished, options, {}).status; };
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
  const FlankFitResult result = finish(good, options, started);
  EXPECT_EQ(result.candidates, 7) << "what was known before stays";
  EXPECT_EQ(result.motions.size(), 1u);
  EXPECT_LT(result.residuals.largest_mm, 1e-9);
  EXPECT_NE(result.message.find("estimated coverage 100.00 % at 0.02 mm"), std::string::npos) << result.message;
}

}  // namespace
}  // namespace flank::internal
