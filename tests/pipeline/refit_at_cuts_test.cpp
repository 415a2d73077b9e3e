#include "flank/pipeline/refit_at_cuts.h"

#include <gtest/gtest.h>

#include "fit/flat_scene.h"
#include "flank/pipeline/repair_judged_cuts.h"
#include "sanitized.h"

namespace flank::internal {
namespace {

using testing::standing_blade;
using testing::upright_motion;

constexpr double kTolerance = 0.02;

/// A tool that lies on the standing blade, all of it.
FitSearch on_blade() {
  FitSearch search;
  TargetGroup group;
  group.target = standing_blade(0.0);
  search.targets.push_back(std::move(group));
  search.group_of_motion = {0};
  search.options.tolerance_mm = kTolerance;
  search.options.bounds = {2.0, 9.0, 0.5};
  search.fit.motions = {upright_motion({.y = 5.0, .z = -1.0, .x_first = -3.0, .x_last = 63.0, .length = 42.0})};
  search.fit.tool = RadialFunction::spline(42.0, Eigen::VectorXd::Constant(6, 5.0));
  return search;
}

/// What a judge says who finds the target F1 cut by `depth` at a place between the samples, and F2, another face, by `gouge`.
VerifyReport judged(double depth, double gouge) {
  const WorstPlace place{.face = "F1", .point = Vec3(30.1, depth, 20.1), .f = -depth, .strip = 0};
  FaceVerdict target, other;
  target.face = "F1";
  target.target = true;
  target.deepest = place;
  other.face = "F2";
  VerifyReport report;
  report.overcut_mm = depth;
  report.gouge_mm = gouge;
  report.faces = {target, other};
  report.worst = {place, {.face = "F2", .point = Vec3::Zero(), .f = -gouge, .strip = 0}};
  return report;
}

TEST(MendCuts, LeadsOutOfWhatTheJudgeFinds) {
  if (kSanitized) GTEST_SKIP() << "passes of 2,500 points";
  FitSearch search = on_blade();
  ASSERT_TRUE(refit_at_cuts(kTolerance, search, judged(1.6 * kTolerance, 0.0)));
  EXPECT_LE(search.fit.after.overcut_mm, kTolerance);
  EXPECT_EQ(search.fit.after.at_tolerance, 1.0);
  EXPECT_TRUE(search.options.extra_overcut_points.empty()) << "of this mending alone";
}

TEST(MendCuts, LeavesWhatIsWithinOrTooDeepOrOfOtherFaces) {
  FitSearch search = on_blade();
  EXPECT_FALSE(refit_at_cuts(kTolerance, search, judged(0.9 * kTolerance, 0.0)));
  EXPECT_FALSE(refit_at_cuts(kTolerance, search, judged(20.0 * kTolerance, 0.0))) << "another motion is needed";
  EXPECT_FALSE(refit_at_cuts(kTolerance, search, judged(0.9 * kTolerance, 3.0 * kTolerance)));
  search.fit.motions.clear();
  EXPECT_FALSE(refit_at_cuts(kTolerance, search, judged(1.6 * kTolerance, 0.0)));
}

TEST(LeadOut, ByAnotherMotionFirstWhichCostsNoCoverage) {
  if (kSanitized) GTEST_SKIP() << "passes of 2,500 points";
  FitSearch search = on_blade();
  std::optional<JudgedFit> before;
  ASSERT_TRUE(repair_judged_cuts(kTolerance, before, search, judged(1.1 * kTolerance, 0.0)));
  EXPECT_EQ(search.fit.after.at_tolerance, 1.0) << "a thinner tool leaves more";
  EXPECT_EQ(before->fit.tool.at(7.0).r, 5.0) << "what was judged is kept";
  const double radius = search.fit.tool.at(7.0).r;
  ASSERT_TRUE(repair_judged_cuts(kTolerance, before, search, judged(1.1 * kTolerance, 0.0)));
  EXPECT_LT(search.fit.tool.at(7.0).r, radius) << "the second time by what is certain";
}

TEST(LeadOut, GivesUpAMotionThatWasLedIntoAnotherFace) {
  FitSearch search = on_blade();
  std::optional<JudgedFit> before = JudgedFit{search.fit, judged(1.1 * kTolerance, 0.0)};
  search.fit.motions.clear();
  ASSERT_TRUE(repair_judged_cuts(kTolerance, before, search, judged(0.9 * kTolerance, 3.0 * kTolerance)));
  EXPECT_EQ(search.fit.motions.size(), 1U);
  EXPECT_LT(search.fit.tool.at(7.0).r, 5.0);
}

TEST(LeadOut, LeavesWhatIsWithin) {
  FitSearch search = on_blade();
  std::optional<JudgedFit> before;
  EXPECT_FALSE(repair_judged_cuts(kTolerance, before, search, judged(0.9 * kTolerance, 0.0)));
}

}  // namespace
}  // namespace flank::internal
