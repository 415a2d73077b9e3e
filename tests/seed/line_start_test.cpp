#include "flank/seed/line_start.h"

#include <gtest/gtest.h>

#include "seed/exact_targets.h"

namespace flank::internal {
namespace {

using testing::barrel_target;
using testing::cone_target;
using testing::ExactTarget;
using testing::plane_target;
using testing::pose_off;

/// A share of the target's diagonal, in mm, along and across the face.
Pose off(const ExactTarget& exact, double t, double share) {
  const double d = share * exact.target->diagonal();
  return pose_off(exact.motion.pose(t), exact.motion.axis_length, d * Vec3(0.5, 0.7, 0.2), d * Vec3(-0.3, -0.8, 0.1));
}

/// Share of the target's samples whose footprint on the motion is nearer than the true radii by at most `slack`.
double covered(const ExactTarget& exact, const RuledMotion& motion, double slack) {
  double area = 0.0, all = 0.0;
  for (const SurfaceSample& sample : exact.target->samples(2.5)) {
    double best = 1e300;
    for (int i = 0; i <= 300; ++i) {
      const Pose pose = motion.pose(i / 300.0);
      const double s = std::clamp(pose.axis.dot(sample.point - pose.tip), 0.0, motion.axis_length);
      best = std::min(best, (sample.point - pose.at(s)).norm() - exact.tool.at(s).r);
    }
    all += sample.area;
    if (std::abs(best) <= slack) area += sample.area;
  }
  return area / all;
}

/// Largest root mean square, over the axis and inside the target, of distance minus true radius along the motion.
double worst_rms(const ExactTarget& exact, const RuledMotion& motion) {
  double worst = 0.0;
  for (int i = 0; i <= 40; ++i) {
    double sum = 0.0;
    int count = 0;
    for (int j = 0; j <= 20; ++j) {
      const double s = motion.axis_length * j / 20.0;
      const Footpoint foot = exact.target->closest(motion.pose(i / 40.0).at(s));
      if (foot.location != Location::kInside) continue;
      sum += std::pow(foot.distance - exact.tool.at(s).r, 2);
      ++count;
    }
    if (count > 4) worst = std::max(worst, std::sqrt(sum / count));
  }
  return worst;
}

TEST(LineStart, AnExactLineRetracesItsEnvelope) {
  for (const ExactTarget& exact : {barrel_target(), cone_target(), plane_target()}) {
    const LineStart start = start_from_line(*exact.target, exact.motion.pose(0.45), exact.motion.axis_length);
    EXPECT_EQ(start.report.status, LineStartStatus::kBorderToBorder) << start.report.message;
    EXPECT_LT(start.report.worst_movability, 1e-4);
    EXPECT_LT(worst_rms(exact, start.motion), 1e-3 * exact.target->diagonal());
    EXPECT_GT(covered(exact, start.motion, 2e-3 * exact.target->diagonal()), 0.97) << start.report.message;
  }
}

TEST(LineStart, ALineOffByAHundredthCoversTheTarget) {
  for (const ExactTarget& exact : {barrel_target(), cone_target(), plane_target()}) {
    const LineStart start = start_from_line(*exact.target, off(exact, 0.5, 0.01), exact.motion.axis_length);
    EXPECT_EQ(start.report.status, LineStartStatus::kBorderToBorder) << start.report.message;
    EXPECT_LE(start.report.movability_after, start.report.movability_before);
    EXPECT_LT(start.report.worst_drift_mm, 1e-4 * exact.target->diagonal());
    EXPECT_LT(worst_rms(exact, start.motion), 2e-2 * exact.target->diagonal());
    EXPECT_GT(covered(exact, start.motion, 2e-2 * exact.target->diagonal()), 0.95) << start.report.message;
  }
}

TEST(LineStart, ReachesALittleBeyondBothBorders) {
  const ExactTarget exact = plane_target();
  const LineStart start = start_from_line(*exact.target, exact.motion.pose(0.3), exact.motion.axis_length);
  const double first = start.motion.pose(0.0).tip.x(), last = start.motion.pose(1.0).tip.x();
  EXPECT_LT(std::min(first, last), -0.02 * exact.target->diagonal());
  EXPECT_GT(std::max(first, last), 60.0 + 0.02 * exact.target->diagonal());
  EXPECT_LT(std::max(first, last), 60.0 + 0.10 * exact.target->diagonal());
}

TEST(LineStart, WorksOnEitherSide) {
  const ExactTarget exact = barrel_target();
  const std::unique_ptr<Target> other = make_target({exact.face}, -1);
  const Pose pose = exact.motion.pose(0.5);
  const double length = exact.motion.axis_length;
  EXPECT_EQ(side_of_line(*exact.target, pose, length), 1);
  EXPECT_EQ(side_of_line(*other, pose, length), -1);
  const LineStart a = start_from_line(*exact.target, pose, length), b = start_from_line(*other, pose, length);
  EXPECT_EQ(b.report.status, LineStartStatus::kBorderToBorder) << b.report.message;
  EXPECT_NEAR(a.report.mean_distance_mm, -b.report.mean_distance_mm, 1e-6);
  EXPECT_NEAR(a.report.travel_mm, b.report.travel_mm, 0.05 * a.report.travel_mm);
}

TEST(LineStart, StopsAtTheMovabilityLimitAndSaysSo) {
  const ExactTarget exact = barrel_target();
  LineStartOptions options;
  options.propagation.movability_limit = 0.0;
  const LineStart start = start_from_line(*exact.target, off(exact, 0.5, 0.02), exact.motion.axis_length, options);
  EXPECT_EQ(start.report.status, LineStartStatus::kNoMotion);
  EXPECT_EQ(start.report.forward, PropagationEnd::kMovability);
  EXPECT_NE(start.report.message.find("no longer fits"), std::string::npos);
}

TEST(LineStart, KeepsTheAxisRigid) {
  const ExactTarget exact = barrel_target();
  const Pose pose = off(exact, 0.5, 0.01);
  const Propagation p = propagate(*exact.target, pose, exact.motion.axis_length, Vec3::UnitX());
  ASSERT_EQ(p.poses.size(), p.travel_mm.size());
  for (const Pose& q : p.poses) EXPECT_NEAR(q.axis.norm(), 1.0, 1e-12);
  for (std::size_t k = 1; k < p.travel_mm.size(); ++k) EXPECT_GT(p.travel_mm[k], p.travel_mm[k - 1]);
}

TEST(LineSearch, StaysWithinItsRadiusAndNeverGetsWorse) {
  for (const ExactTarget& exact : {barrel_target(), cone_target()}) {
    for (const double share : {0.005, 0.02, 0.05}) {
      const Pose pose = off(exact, 0.4, share);
      const LineSearch search = search_line(*exact.target, pose, exact.motion.axis_length);
      EXPECT_LE(search.after.value, search.before.value);
      EXPECT_LE(search.shift_mm, 0.01 * exact.target->diagonal() * (1.0 + 1e-9));
      EXPECT_LT((search.pose.at(0.5 * exact.motion.axis_length) - pose.at(0.5 * exact.motion.axis_length)).norm(),
                0.011 * exact.target->diagonal());
    }
  }
}

TEST(LineSearch, FindsAMovableLine) {
  const ExactTarget exact = barrel_target();
  const LineSearch search = search_line(*exact.target, off(exact, 0.5, 0.01), exact.motion.axis_length);
  EXPECT_LT(search.after.value, 0.05 * search.before.value);
}

}  // namespace
}  // namespace flank::internal
