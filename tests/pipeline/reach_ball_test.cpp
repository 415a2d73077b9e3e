#include "flank/pipeline/search/reach_ball.h"

#include <gtest/gtest.h>

#include <cmath>

#include "flank/setup/targets.h"
#include "setup/corner_part.h"

namespace flank::internal {
namespace {

/// Of the floor of a corner: 20 by 30 mm, so that a stiff cylinder across it has a radius of 1.53 mm, and tools 0.36 mm at least.
double ball_beside_fillet(double radius, const FitJob& job = {}) {
  flank::internal::Setup setup;
  setup.part = testing::corner(true, radius);
  setup.targets = {0};
  const std::vector<TargetGroup> targets = make_targets(setup);
  const Target& target = *targets.front().target;
  return demanded_reach(job, setup, target, bounds_for(job, target));
}

const double kStiff = three_digits(std::sqrt(20.0 * 30.0) / 16.0);

TEST(DemandedReach, IsThatOfAStiffCylinderOrOfAFillet) {
  EXPECT_DOUBLE_EQ(ball_beside_fillet(5.0), kStiff);
  EXPECT_NEAR(ball_beside_fillet(1.0), 1.0, 0.01);
}

TEST(DemandedReach, IsNoSmallerThanTools) {
  FitJob job;
  job.radius.min_mm = 0.5;
  EXPECT_DOUBLE_EQ(ball_beside_fillet(0.4, job), 0.5);
}

TEST(DemandedReach, IsWhatTheUserAsks) {
  FitJob job;
  job.judge.reach_radius_mm = 3.0;
  EXPECT_DOUBLE_EQ(ball_beside_fillet(1.0, job), 3.0);
}

}  // namespace
}  // namespace flank::internal
