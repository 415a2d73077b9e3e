#include "flank/pipeline/run_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "flank/error.h"
#include "flank/part.h"
#include "flank/run.h"
#include "flank/setup/tool_body.h"
#include "sanitized.h"
#include "shared_data.h"

namespace flank::internal {
namespace {

const RadialFunction kCone(ToolFamily::kCone, 20.0, Eigen::Vector2d(4.0, 0.05));

TEST(RunFit, RefusesALargestRadiusThatIsNotAboveTheLeast) {
  RadiusRequest radius;
  EXPECT_NO_THROW(check_radius(radius));
  radius.max_mm = 2.0;
  EXPECT_NO_THROW(check_radius(radius));
  radius.min_mm = 1.0;
  EXPECT_NO_THROW(check_radius(radius));
  radius.min_mm = 2.0;
  EXPECT_THROW(check_radius(radius), UsageError);
  radius = {};
  radius.max_mm = 0.0;
  EXPECT_THROW(check_radius(radius), UsageError);
}

TEST(RunFit, NamesTheToolThatWasFoundAndKeepsTheGivenOne) {
  ToolSpec spec;
  spec.free = true;
  EXPECT_EQ(found_tool(spec, kCone, {}).name, "free");
  spec.free = false;
  EXPECT_EQ(found_tool(spec, kCone, {}).name, family_name(ToolFamily::kCone));
  EXPECT_EQ(found_tool(spec, kCone, {}).radial.at(10.0).r, kCone.at(10.0).r);
  Tool given;
  given.name = "given";
  given.radial = RadialFunction(ToolFamily::kCylinder, 30.0, Eigen::Matrix<double, 1, 1>(5.0));
  spec.tool = given;
  EXPECT_EQ(found_tool(spec, kCone, {}).name, "given");
  EXPECT_EQ(found_tool(spec, kCone, {}).radial.axis_length(), 30.0);
}

TEST(RunFit, HasABodyIfOneIsAskedForOrGiven) {
  ToolSpec spec;
  ObstacleRequest asked;
  EXPECT_FALSE(has_body(spec, asked));
  asked.shank_length_mm = 30.0;
  EXPECT_TRUE(has_body(spec, asked));
  EXPECT_TRUE(has_body(found_tool(spec, kCone, asked)));
  spec.tool = found_tool(spec, kCone, asked);
  EXPECT_TRUE(has_body(spec, {}));
}

/// A verdict on a face that is cut nowhere too deep.
VerifyReport covered(double measured, double proved) {
  VerifyReport report;
  report.verdict = Verdict::kPass;
  report.coverage_reachable = measured;
  report.coverage_reachable_bound = proved;
  return report;
}

TEST(RunFit, SearchesOnceMoreWhereAHairIsMissing) {
  FitJob job;
  job.strips = 0;
  EXPECT_NEAR(spare_needed(job, covered(0.9913, 0.9895), 0.9940), 0.9940 - 0.9895, 1e-12) << "what is proved counts";
  EXPECT_EQ(spare_needed(job, covered(0.9940, 0.9902), 0.9940), 0.0) << "nothing is missing";
  EXPECT_EQ(spare_needed(job, covered(0.8, 0.79), 0.9940), 0.0) << "no strip more gives that";
  EXPECT_EQ(spare_needed(job, covered(0.9895, 0.9890), 0.9880), 0.0) << "the search knew, and had tried all";
  VerifyReport deep = covered(0.9913, 0.9895);
  deep.verdict = Verdict::kOvercut;
  EXPECT_EQ(spare_needed(job, deep, 0.9940), 0.0);
  job.strips = 1;
  EXPECT_EQ(spare_needed(job, covered(0.9913, 0.9895), 0.9940), 0.0) << "strips are as many as was asked";
}

TEST(RunFit, TellsTheFiguresOfAFit) {
  FlankFitResult fit;
  fit.candidates = 3;
  fit.before.at_tolerance = 0.5, fit.after.at_tolerance = 0.9, fit.after.overcut_mm = 0.01;
  fit.residuals.rms_mm = 0.002;
  fit.trace.resize(2);
  fit.trace.back().cost = 7.0;
  const FitSummary summary = fit_summary(fit);
  EXPECT_EQ(summary.candidates, 3);
  EXPECT_EQ(summary.before.coverage, 0.5);
  EXPECT_EQ(summary.after.coverage, 0.9);
  EXPECT_EQ(summary.after.overcut_mm, 0.01);
  EXPECT_EQ(summary.rms_mm, 0.002);
  ASSERT_EQ(summary.trace.size(), 2u);
  EXPECT_EQ(summary.trace.back().cost, 7.0);
}

TEST(RunFit, TellsWhatWasTriedAsSharesOfTheWholeFace) {
  FlankFitResult fit;
  RejectedTool rejected{
      .slenderness = 4.0, .axis_length_mm = 40.0, .largest_radius_mm = 5.0, .strips = 2, .estimate = {}};
  rejected.estimate.at_tolerance = 0.9, rejected.estimate.gouge_mm = 0.03;
  fit.rejected = {rejected, rejected, rejected};
  fit.rejected[1].slenderness = std::numeric_limits<double>::infinity();
  fit.rejected[2].estimate.overcut_mm = std::numeric_limits<double>::infinity();
  FitJob job;
  const std::vector<StiffnessStep> steps = stiffness_steps(fit, job, 0.5);
  ASSERT_EQ(steps.size(), 1u) << "neither what is no tool nor a fit that lost its values";
  EXPECT_EQ(steps[0].coverage, 0.45);
  EXPECT_EQ(steps[0].coverage_reachable, 0.9);
  EXPECT_EQ(steps[0].gouge_mm, 0.03);
  EXPECT_EQ(steps[0].strips, 2);
  EXPECT_FALSE(steps[0].judged);
  job.avoid = false;
  EXPECT_EQ(stiffness_steps(fit, job, 0.5)[0].coverage, 0.9) << "the planner counts the whole face then";
  EXPECT_FALSE(stiffness_steps(fit, job, 0.5)[0].coverage_reachable);
}

TEST(RunFit, RefusesACurveOfAGivenTool) {
  FitJob job;
  job.part.file = "no.step";
  job.tool.spec = "cone:radius=2,angle=3";
  job.stiffness_curve = true;
  EXPECT_THROW((void)run_fit(job), UsageError);
}

/// Every plan with a shank that is chosen for its path: the folder's job has it, it reaches out of the part, and it is told.
template <class Job>
void expect_chosen_shank(const Result& result, const std::string& part) {
  const ObstacleRequest& chosen = std::get<Job>(result.job).obstacles;
  EXPECT_EQ(chosen.shank, "given");
  ASSERT_TRUE(chosen.shank_length_mm);
  ASSERT_FALSE(result.tool.shank.empty());
  ASSERT_FALSE(result.path.strips.empty());
  const Box3 box = read_part(part).box;
  for (const Strip& strip : result.path.strips)
    for (const Pose& pose : strip.poses) {
      const Vec3 end = pose.at(result.tool.shank.back().x());
      EXPECT_TRUE((end.array() < box.low.array()).any() || (end.array() > box.high.array()).any());
    }
  EXPECT_TRUE(result.verify.clearance.kept());
  EXPECT_EQ(std::count_if(result.notes.begin(), result.notes.end(),
                          [](const std::string& note) { return note.starts_with("the shank was chosen: "); }),
            1);
}

TEST(RunFit, ChoosesAShankWhereNothingSaysWhatStandsAboveTheFlank) {
  if (kSanitized) GTEST_SKIP() << "a whole search";
  FLANK_REAL_PART(blade, "r37_blade.step");
  FitJob job;
  job.part.file = blade;
  job.part.faces = "F1";
  job.tolerance_mm = 0.3;
  expect_chosen_shank<FitJob>(run_fit(job, {}), blade);
}

TEST(RunCover, ChoosesAShankWhereNothingSaysWhatStandsAboveTheFlank) {
  if (kSanitized) GTEST_SKIP() << "a whole cover";
  FLANK_REAL_PART(blade, "r37_blade.step");
  CoverJob job;
  job.part.file = blade;
  job.part.faces = "F1";
  job.tool.spec = "cylinder:radius=6";
  job.tool.axis_length_mm = 60.0;
  job.tolerance_mm = 0.3;
  expect_chosen_shank<CoverJob>(run_cover(job, {}), blade);
}

}  // namespace
}  // namespace flank::internal
