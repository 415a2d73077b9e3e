// The points of a pass: they stand for the target's area, each target once, rim included; the same for any number of threads.
#include "flank/fit/swept_pass.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "fit/flat_scene.h"
#include "flank/threads.h"

namespace flank::internal {
namespace {

using testing::standing_blade;
using testing::upright_motion;

FitDraft draft_of(const Target& target, int strips) {
  FitDraft draft;
  draft.targets.assign(static_cast<std::size_t>(strips), &target);
  draft.motions.assign(static_cast<std::size_t>(strips),
                       upright_motion({.y = 3.0, .z = -1.0, .x_first = -3.0, .x_last = 63.0, .length = 42.0}));
  draft.tool = RadialFunction::spline(42.0, Eigen::VectorXd::Constant(6, 3.0));
  return draft;
}

double share_of(const std::vector<FacePoint>& points) {
  return std::accumulate(points.begin(), points.end(), 0.0,
                         [](double sum, const FacePoint& point) { return sum + point.share; });
}

TEST(TargetPoints, StandForTheAreaAndALittleForTheRim) {
  const auto blade = standing_blade(0.0);
  const std::vector<FacePoint> points = target_points(draft_of(*blade, 1), 30);
  EXPECT_GT(share_of(points), 1.0 - 1e-9);
  EXPECT_LT(share_of(points), 1.2);
  EXPECT_TRUE(std::all_of(points.begin(), points.end(),
                          [](const FacePoint& point) { return point.role == FacePoint::Role::kTouch; }));
}

TEST(TargetPoints, StripsOnOneTargetShareItsPointsWhichGetDenser) {
  const auto blade = standing_blade(0.0);
  const auto one = target_points(draft_of(*blade, 1), 20), four = target_points(draft_of(*blade, 4), 20);
  EXPECT_NEAR(static_cast<double>(four.size()) / static_cast<double>(one.size()), 4.0, 1.0);
  EXPECT_LT(share_of(four), 1.2);
}

TEST(TargetPoints, AreTheSameForOneAndThreeThreads) {
  const auto blade = standing_blade(0.0);
  set_thread_count(1);
  const auto one = target_points(draft_of(*blade, 1), 20);
  set_thread_count(3);
  const auto three = target_points(draft_of(*blade, 1), 20);
  set_thread_count(0);
  ASSERT_EQ(one.size(), three.size());
  for (std::size_t k = 0; k < one.size(); ++k) EXPECT_EQ(one[k].point, three[k].point);
}

}  // namespace
}  // namespace flank::internal
