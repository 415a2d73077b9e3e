// Candidates against each other on a flat blade, where any upright cylinder is exact: who is tried, and who wins.
#include "flank/fit/finalists.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "fit/flat_scene.h"
#include "flank/base/journal.h"
#include "flank/fit/rank.h"
#include "flank/threads.h"
#include "flank/tool/compliance.h"

namespace flank::internal {
namespace {

using testing::standing_blade;
using testing::Upright;
using testing::upright_motion;

class Racing : public ::testing::Test {
 protected:
  Racing() {
    options_.tolerance_mm = 0.02;
    options_.bounds = {1.0, 9.0, 0.5};
    options_.sample_share = 1.0 / 15.0;
  }
  /// Upright before the blade, `off` mm too far from it, with a free tool of this radius.
  [[nodiscard]] FitDraft start(double radius, double off = 0.0, double x_last = 63.0) const {
    FitDraft draft;
    draft.targets = {blade_.get()};
    draft.motions = {upright_motion({.y = radius + off, .z = -1.0, .x_first = -3.0, .x_last = x_last, .length = 42.0})};
    draft.tool = RadialFunction::spline(42.0, Eigen::VectorXd::Constant(6, radius));
    draft.free_tool = true;
    return draft;
  }
  [[nodiscard]] FitCandidate run(const std::vector<FitDraft>& starts) const {
    return run_finalists(starts, ranking_samples(*blade_, nullptr, options_), options_, {});
  }

  std::unique_ptr<Target> blade_ = standing_blade(0.0);
  FlankFitOptions options_;
};

TEST_F(Racing, OfTwoThatDoWhatWasAskedTheStifferToolWins) {
  for (const auto& order : {std::vector{2.0, 6.0}, std::vector{6.0, 2.0}}) {
    const FitCandidate winner = run({start(order[0]), start(order[1])});
    EXPECT_TRUE(winner.enough);
    EXPECT_TRUE(meets(winner.polished.estimate, options_.enough_coverage, options_));
    EXPECT_NEAR(winner.polished.draft.tool.at(21.0).r, 6.0, 0.5);
  }
}

TEST_F(Racing, AStifferToolMustNotCostWhatTheDemandedBallDoesNotReach) {
  constexpr double kThin = 3.0, kThick = 6.0;  // mm; the demand is for what the thick one touches
  const ObstacleField hub(testing::only(testing::hub(true)), *blade_, 2.0, 0.8 * options_.tolerance_mm);
  options_.reach_radius_mm = kThick;
  std::vector<FitDraft> starts;
  for (const double radius : {kThick, kThin}) {
    starts.push_back(start(radius));
    starts.back().obstacles = {&hub};
    starts.back().motions = {
        upright_motion({.y = radius, .z = radius, .x_first = -3.0, .x_last = 63.0, .length = 42.0})};
  }
  const FitCandidate winner = run_finalists(starts, ranking_samples(*blade_, &hub, options_), options_, {});
  EXPECT_TRUE(winner.enough);
  EXPECT_NEAR(winner.polished.draft.tool.at(21.0).r, kThin, 0.5);
}

TEST_F(Racing, NobodyIsTriedOnceOneIsEnough) {
  // The third would win: it is stiffer than both.
  const std::vector<FitDraft> starts = {start(2.0), start(3.0), start(8.0)};
  EXPECT_NEAR(run(starts).polished.draft.tool.at(21.0).r, 3.0, 0.5);
  options_.enough_coverage = 1.1;  // never
  options_.finalists = 1;
  EXPECT_TRUE(run(starts).polished.estimate.at_tolerance > 0.99);
}

TEST_F(Racing, WhoCoversMoreWinsWhereNobodyDoesWhatWasAsked) {
  // Half of the path each: neither a polish nor the last passes make it longer.
  options_.finalists = 1;
  options_.bounds.largest = 3.0;
  const FitCandidate winner = run({start(3.0, 0.0, 10.0), start(3.0, 0.0, 40.0)});
  EXPECT_GT(winner.start.motions.front().tip.poles(0, 7), 39.0);
}

TEST_F(Racing, AToolMoreSlenderThanAskedIsNotEnough) {
  options_.bounds.largest = 3.0;
  options_.finalists = 1;
  EXPECT_TRUE(run({start(3.0)}).enough);
  options_.bounds.slenderest = 7.0;  // of 42 mm: a radius of 3 everywhere, which a soft bound does not quite give
  const FitCandidate bounded = run({start(2.0)});
  EXPECT_GT(bounded.polished.estimate.at_tolerance, 0.99);
  EXPECT_GT(slenderness(42.0, compliance(bounded.polished.draft.tool)), 7.0);
  EXPECT_FALSE(bounded.enough);
  // A tool as thick as allowed is all that can be had.
  options_.bounds.slenderest = 5.0;
  EXPECT_TRUE(run({start(3.0)}).enough);
}

TEST_F(Racing, WhatCoversEnoughAndGainedNothingGetsNoMorePasses) {
  options_.bounds.largest = 3.0;
  options_.is_free_line = [](const Vec3&, const Vec3&) { return false; };  // nothing is ever held
  Progress progress;
  progress.journal = std::make_shared<Progress::Journal>();
  const std::vector<FitDraft> starts = {start(2.0, 0.3)};
  const FitCandidate winner = run_finalists(starts, ranking_samples(*blade_, nullptr, options_), options_, progress);
  EXPECT_GE(winner.polished.estimate.at_tolerance, options_.enough_coverage);
  EXPECT_FALSE(winner.enough);
  const auto steps = progress.journal->steps();
  EXPECT_EQ(std::count_if(steps.begin(), steps.end(), [](const auto& step) { return step.name == "fine fit"; }), 1);
}

TEST_F(Racing, WhatACloseLookHasCalledShortIsNotLookedAtAgain) {
  options_.bounds.largest = 3.0;
  const auto samples = ranking_samples(*blade_, nullptr, options_);
  // A motion that ends somewhere on the blade: some such end lies where few samples call more covered than many do.
  FitCandidate candidate{.start = {}, .polished = {}, .trace = {}, .beaten = {}};
  double seen = 0.0, rough = 0.0;
  for (double x_last = 40.0; x_last < 44.0 && !(rough > seen + 1e-3); x_last += 0.3) {
    candidate.polished = assess(start(2.0, 0.0, x_last), samples, options_);
    rough = candidate.polished.estimate.at_tolerance;
    seen = measured_closely(candidate.polished, samples, options_).estimate.at_tolerance;
  }
  ASSERT_GT(rough, seen + 1e-3);
  options_.enough_coverage = 0.5 * (rough + seen);
  ASSERT_TRUE(meets(candidate.polished.estimate, options_.enough_coverage, options_));
  settle_if_enough(candidate, samples, options_);
  EXPECT_FALSE(candidate.enough);
  ASSERT_TRUE(candidate.close);
  EXPECT_EQ(candidate.failed_close_score, candidate.polished.estimate.score(options_.tolerance_mm));
  candidate.close->estimate.rms_mm = 7.0;  // to be known again
  settle_if_enough(candidate, samples, options_);
  EXPECT_EQ(candidate.close->estimate.rms_mm, 7.0);
  look_closely(candidate, samples, options_);
  EXPECT_EQ(candidate.polished.estimate.rms_mm, 7.0);
}

TEST_F(Racing, IsTheSameForOneAndThreeThreads) {
  const std::vector<FitDraft> starts = {start(4.0, 0.3), start(5.0, -0.2), start(6.0, 0.1)};
  set_thread_count(1);
  const FitCandidate one = run(starts);
  set_thread_count(3);
  const FitCandidate three = run(starts);
  set_thread_count(0);
  EXPECT_EQ(one.polished.draft.tool.parameters(), three.polished.draft.tool.parameters());
  EXPECT_EQ(one.polished.draft.motions.front().tip.poles, three.polished.draft.motions.front().tip.poles);
  EXPECT_EQ(one.trace.size(), three.trace.size());
}

TEST_F(Racing, TellsWhatWasBeatenAndWhatWasFound) {
  double most = 0.0;
  Progress progress;
  progress.found = [&](const BestSoFar& best) { most = std::max(most, best.coverage); };
  const std::vector<FitDraft> starts = {start(2.0), start(6.0)};
  const FitCandidate winner = run_finalists(starts, ranking_samples(*blade_, nullptr, options_), options_, progress);
  ASSERT_EQ(winner.beaten.size(), 1u);
  EXPECT_NEAR(winner.beaten[0].largest_radius_mm, 2.0, 0.5);
  EXPECT_NEAR(winner.beaten[0].slenderness, 42.0 / 4.0, 2.0);
  EXPECT_EQ(winner.beaten[0].axis_length_mm, 42.0);
  EXPECT_EQ(winner.beaten[0].strips, 1);
  EXPECT_GT(winner.beaten[0].estimate.at_tolerance, 0.99);
  EXPECT_GT(most, 0.99);
}

}  // namespace
}  // namespace flank::internal
