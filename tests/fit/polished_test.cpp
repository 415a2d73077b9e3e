// What is measured of a draft: its turn, what is out of reach, and whether anything could hold its tool.
#include "flank/fit/polished.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fit/flat_scene.h"
#include "flank/threads.h"

namespace flank::internal {
namespace {

using testing::standing_blade;
using testing::upright_motion;

FlankFitOptions options() {
  FlankFitOptions options;
  options.tolerance_mm = 0.02;
  options.bounds = {1.0, 9.0, 0.5};
  options.sample_share = 1.0 / 15.0;
  return options;
}

FitDraft upright_draft(const Target& target) {
  FitDraft draft;
  draft.targets = {&target};
  draft.motions = {upright_motion({.y = 3.0, .z = -1.0, .x_first = -3.0, .x_last = 63.0, .length = 42.0})};
  draft.tool = RadialFunction::spline(42.0, Eigen::VectorXd::Constant(6, 3.0));
  draft.free_tool = true;
  return draft;
}

TEST(Assess, TellsCoverageSlendernessAndAStraightWay) {
  const auto blade = standing_blade(0.0);
  const Polished seen = assess(upright_draft(*blade), ranking_samples(*blade, nullptr, options()), options());
  EXPECT_GT(seen.estimate.at_tolerance, 0.99);
  EXPECT_EQ(seen.estimate.of_whole, seen.estimate.at_tolerance);
  EXPECT_NEAR(seen.estimate.slenderness, 7.0, 1e-6);
  EXPECT_LT(seen.estimate.turn * kMostTurnRad, 1e-6);
  EXPECT_EQ(seen.estimate.unheld, 0.0);
}

TEST(Assess, AKinkIsSeenInTheDraftAndInWhatIsWritten) {
  const auto blade = standing_blade(0.0);
  FitDraft draft = upright_draft(*blade);
  // The middle of the way once more, back and forth: a V.
  const auto middle = draft.motions[0].tip.poles.cols() / 2;
  draft.motions[0].tip.poles.col(middle).x() -= 20.0;
  const Polished seen = assess(draft, ranking_samples(*blade, nullptr, options()), options());
  EXPECT_GT(seen.estimate.turn * kMostTurnRad, 2.0);
  CoverageEstimate written;
  measure_written(draft, options(), written);
  EXPECT_GT(written.turn * kMostTurnRad, 2.0);
}

TEST(Assess, WhereNoLineIsFreeNothingHoldsTheTool) {
  const auto blade = standing_blade(0.0);
  FlankFitOptions under = options();
  under.is_free_line = [](const Vec3& from, const Vec3&) { return from.x() > 30.0; };
  const Polished seen = assess(upright_draft(*blade), ranking_samples(*blade, nullptr, under), under);
  EXPECT_NEAR(seen.estimate.unheld, 0.5, 0.05);
}

TEST(RankingSamples, AreTheSameForOneAndThreeThreads) {
  const auto blade = standing_blade(0.0);
  set_thread_count(1);
  const auto one = ranking_samples(*blade, nullptr, options());
  set_thread_count(3);
  const auto three = ranking_samples(*blade, nullptr, options());
  set_thread_count(0);
  ASSERT_EQ(one.size(), three.size());
  for (std::size_t k = 0; k < one.size(); ++k) EXPECT_EQ(one[k].area, three[k].area);
}

}  // namespace
}  // namespace flank::internal
