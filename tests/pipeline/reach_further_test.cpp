// What a search that is done leaves of the whole face, by the ball of the demand, goes to a tool that is thinner than it.
#include "flank/pipeline/search/reach_further.h"

#include <gtest/gtest.h>

#include "fit/flat_scene.h"
#include "flank/fit/coverage.h"
#include "flank/fit/rejected.h"
#include "flank/threads.h"
#include "sanitized.h"

namespace flank::internal {
namespace {

using testing::hub;
using testing::only;
using testing::standing_blade;
using testing::upright_motion;

constexpr double kTolerance = 0.02;
constexpr double kRadius = 2.4, kBall = 6.0;  // mm: of the tool, and of the ball that the demand asks with

/// A cylinder before the blade on its hub, in a motion that finishes what the ball touches, and leaves a strip of the blade
/// below that it would have room for.
class ReachFurther : public ::testing::Test {
 protected:
  ReachFurther() {
    options_.tolerance_mm = kTolerance;
    options_.bounds = {1.0, 9.0, 0.5};
    options_.bounds.slenderest = 9.0;
    options_.reach_radius_mm = kBall;
    options_.sample_share = 1.0 / 15.0;
    found_.tool = RadialFunction::spline(40.0, Eigen::VectorXd::Constant(6, kRadius));
    found_.motions = {
        upright_motion({.y = kRadius, .z = kBall - 1.0, .x_first = -3.0, .x_last = 63.0, .length = 40.0})};
    found_.after.at_tolerance = 1.0;
  }
  [[nodiscard]] FlankFitResult further(const FlankFitResult& found) const {
    return reach_further({{blade_.get(), found.motions.front(), &hub_}}, found, {}, options_, {});
  }
  /// Of the whole blade.
  [[nodiscard]] double covered(const FlankFitResult& fit) const {
    return estimate_coverage(blade_->samples(0.5), fit.motions, fit.tool, kTolerance, 200).at_tolerance;
  }

  std::unique_ptr<Target> blade_ = standing_blade(0.0);
  ObstacleField hub_{only(hub(true)), *blade_, 2.0, 0.8 * kTolerance};
  FlankFitOptions options_;
  FlankFitResult found_;
};

TEST_F(ReachFurther, FinishesWhatTheToolTouchesAndTheDemandedBallDoesNot) {
  if (kSanitized) GTEST_SKIP() << "a pass of 2,500 points";
  const FlankFitResult more = further(found_);
  const double below =
      (kBall - 1.0 - kRadius) / 40.0;  // share of the blade from where the ball rests on the hub up to the tip
  EXPECT_GE(covered(more), covered(found_) + 0.5 * below);
  EXPECT_EQ(more.after.at_tolerance, 1.0) << "what was asked for";
  EXPECT_LE(more.after.overcut_mm, kTolerance);
  EXPECT_LE(more.after.gouge_mm, kTolerance);
  EXPECT_LE(slenderness_of(more.tool, options_.bounds), options_.bounds.slenderest);
}

TEST_F(ReachFurther, LeavesWhatCoversAllOrEntersSomething) {
  FlankFitResult all = found_;
  all.motions = {upright_motion({.y = kRadius, .z = -1.0, .x_first = -3.0, .x_last = 63.0, .length = 42.0})};
  all.tool = RadialFunction::spline(42.0, Eigen::VectorXd::Constant(6, kRadius));
  EXPECT_EQ(further(all).motions.front().tip.poles, all.motions.front().tip.poles);
  FlankFitResult deep = found_;
  deep.after.gouge_mm = 2.0 * kTolerance;
  EXPECT_EQ(further(deep).motions.front().tip.poles, deep.motions.front().tip.poles);
}

TEST_F(ReachFurther, IsTheSameForOneAndThreeThreads) {
  if (kSanitized) GTEST_SKIP() << "a pass of 2,500 points, twice";
  set_thread_count(1);
  const FlankFitResult one = further(found_);
  set_thread_count(3);
  const FlankFitResult three = further(found_);
  set_thread_count(0);
  EXPECT_EQ(one.motions.front().tip.poles, three.motions.front().tip.poles);
  EXPECT_EQ(one.tool.parameters(), three.tool.parameters());
}

}  // namespace
}  // namespace flank::internal
