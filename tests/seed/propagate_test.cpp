// Lines pushed along a target: straight over a plane, round a tube, along the motions that made their envelopes.
#include "flank/seed/propagate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "seed/exact_targets.h"
#include "seed/sheet.h"

namespace flank::internal {
namespace {

using testing::ExactTarget;

/// A line that leans over the plane z = 0, 100 x 40 mm, by a constant slope along itself.
struct Plane {
  std::unique_ptr<Target> target = make_target({testing::rectangle(0.0, 0.0, 100.0, 40.0)});
  Pose line{Vec3(30.0, 5.0, 4.0), Vec3(0.0, 1.0, 0.1).normalized()};
  double length = 30.0;
};

Vec3 middle(const Pose& pose, double length) { return pose.at(0.5 * length); }

TEST(Propagate, RunsStraightOverAPlane) {
  const Plane plane;
  const double size = plane.target->diagonal();
  const Propagation way = propagate(*plane.target, plane.line, plane.length, Vec3::UnitX());
  EXPECT_EQ(way.end, PropagationEnd::kBorder);
  EXPECT_LT(way.worst_movability, 1e-15);
  EXPECT_LT(way.worst_drift_mm, 1e-9);
  for (const Pose& pose : way.poses) {
    EXPECT_NEAR((pose.axis - plane.line.axis).norm(), 0.0, 1e-9);
    EXPECT_NEAR(pose.tip.y(), 5.0, 1e-6);
    EXPECT_NEAR(pose.tip.z(), 4.0, 1e-9);
  }
  EXPECT_EQ(way.poses.front().tip, plane.line.tip);
  EXPECT_GT(way.poses.back().tip.x(), 100.0 + 0.02 * size - 1e-6) << "the overrun";
  EXPECT_LT(way.poses.back().tip.x(), 100.0 + (0.02 + 0.01) * size + 1e-6) << "it leaves the target by a short step";
}

TEST(Propagate, TheHeadingsPartAcrossTheAxisDecides) {
  const Plane plane;
  for (const Vec3& heading : {Vec3(-0.01, 3.0, 0.3), Vec3(-1.0, 0.0, 5.0), Vec3(-7.0, -20.0, 0.0)}) {
    const Propagation way = propagate(*plane.target, plane.line, plane.length, heading);
    EXPECT_EQ(way.end, PropagationEnd::kBorder);
    EXPECT_LT(way.poses.back().tip.x(), 0.0);
    for (std::size_t k = 1; k < way.poses.size(); ++k) EXPECT_LT(way.poses[k].tip.x(), way.poses[k - 1].tip.x());
  }
}

TEST(Propagate, StepsAreWithinTheirBounds) {
  const Plane plane;
  const double size = plane.target->diagonal();
  const Propagation way = propagate(*plane.target, plane.line, plane.length, Vec3::UnitX());
  ASSERT_EQ(way.travel_mm.size(), way.poses.size());
  ASSERT_LE(way.steps, static_cast<int>(way.poses.size()) - 1);
  EXPECT_NEAR(way.travel_mm[1], 0.01 * size, 1e-12) << "the first step";
  for (int k = 1; k <= way.steps; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double step = way.travel_mm[i] - way.travel_mm[i - 1];
    EXPECT_LE(step, 0.04 * size * (1.0 + 1e-12));
    EXPECT_GE(step, 2e-4 * size);
    EXPECT_NEAR((middle(way.poses[i], plane.length) - middle(way.poses[i - 1], plane.length)).norm(), step,
                1e-6 * step);
  }
}

TEST(Propagate, LongerOverrunsRunFarther) {
  const Plane plane;
  const double size = plane.target->diagonal();
  const Propagation little = propagate(*plane.target, plane.line, plane.length, Vec3::UnitX(), {.overrun_share = 0.01});
  const Propagation much = propagate(*plane.target, plane.line, plane.length, Vec3::UnitX(), {.overrun_share = 0.1});
  EXPECT_EQ(little.steps, much.steps);
  EXPECT_NEAR(much.travel_mm.back() - little.travel_mm.back(), 0.09 * size, 1e-9);
  EXPECT_NEAR(much.poses.back().tip.x() - little.poses.back().tip.x(), 0.09 * size, 1e-6);
}

TEST(Propagate, KeepsTheDistancesOfItsStart) {
  // On an envelope they are the tool's radii; which of the motions that keep them it takes, they leave open.
  for (const ExactTarget& exact : {testing::barrel_target(), testing::cone_target()}) {
    const double length = exact.motion.axis_length, size = exact.target->diagonal();
    const Propagation way = propagate(*exact.target, exact.motion.pose(0.5), length, Vec3::UnitX());
    EXPECT_EQ(way.end, PropagationEnd::kBorder);
    EXPECT_LT(way.worst_drift_mm, 1e-4 * size);
    int inside = 0;
    for (int k = 0; k <= way.steps; ++k) {
      for (int j = 0; j <= 16; ++j) {
        const double s = length * j / 16.0;
        const Footpoint foot = exact.target->closest(way.poses[static_cast<std::size_t>(k)].at(s));
        if (foot.location != Location::kInside) continue;
        ++inside;
        EXPECT_NEAR(foot.distance, exact.tool.at(s).r, 5e-4 * size) << k << " " << s;
      }
    }
    EXPECT_GT(inside, 10 * way.steps);
  }
}

TEST(Propagate, ThereAndBackIsTheSameLine) {
  const ExactTarget exact = testing::cone_target();
  const double length = exact.motion.axis_length, size = exact.target->diagonal();
  const Propagation there = propagate(*exact.target, exact.motion.pose(0.4), length, Vec3::UnitX());
  ASSERT_GT(there.steps, 6);
  const Pose far = there.poses[static_cast<std::size_t>(there.steps / 2)];
  const Propagation back = propagate(*exact.target, far, length, -Vec3::UnitX());
  double least = 1e300;
  for (std::size_t k = 0; k + 1 < back.poses.size(); ++k) {
    const Vec3 a = back.poses[k].tip, step = back.poses[k + 1].tip - a, to = there.poses.front().tip - a;
    const double f = std::clamp(to.dot(step) / step.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (to - f * step).norm());
  }
  EXPECT_LT(least, 5e-3 * size);
}

TEST(Propagate, GoesRoundATubeUntilItHasTravelledEnough) {
  constexpr double kRadius = 20.0, kTool = 5.0, kLength = 20.0;
  const auto target = make_target(testing::tube(kRadius, 40.0, 96, 24));
  const Pose line{Vec3(kRadius + kTool, 0.0, 10.0), Vec3::UnitZ()};
  const PropagationOptions options{.longest_travel_share = 3.0};
  const Propagation way = propagate(*target, line, kLength, Vec3::UnitY(), options);
  EXPECT_EQ(way.end, PropagationEnd::kTravel);
  const double size = target->diagonal();
  EXPECT_GT(way.travel_mm.back(), 3.0 * size);
  EXPECT_LE(way.travel_mm.back(), 3.04 * size + 1e-9);
  EXPECT_GT(way.travel_mm.back(), 2.0 * 3.14159 * (kRadius + kTool)) << "once round, and more";
  EXPECT_LT(way.worst_drift_mm, 0.02);
  for (const Pose& pose : way.poses) {
    EXPECT_NEAR(pose.at(0.5 * kLength).head<2>().norm(), kRadius + kTool, 0.05);
    EXPECT_NEAR(pose.axis.z(), 1.0, 1e-2);
  }
}

TEST(Propagate, ALineThatCannotMoveStaysWhereItIs) {
  const ExactTarget exact = testing::barrel_target();
  const Pose line = testing::pose_off(exact.motion.pose(0.5), 40.0, Vec3(1.0, 2.0, 0.0), Vec3(-1.0, -2.0, 0.0));
  const Propagation way = propagate(*exact.target, line, 40.0, Vec3::UnitX(), {.movability_limit = 1e-12});
  EXPECT_EQ(way.end, PropagationEnd::kMovability);
  EXPECT_EQ(way.steps, 0);
  EXPECT_EQ(way.poses.size(), 1u);
  EXPECT_EQ(way.travel_mm, std::vector<double>{0.0});
}

TEST(Propagate, MovesWithItsTarget) {
  const Eigen::AngleAxisd turn(1.1, Vec3(0.4, 0.8, -0.3).normalized());
  const Vec3 shift(15.0, -80.0, 33.0);
  const ExactTarget exact = testing::cone_target();
  const auto moved = make_target({testing::moved(exact.face, turn, shift)});
  const Pose line = exact.motion.pose(0.5);
  // Steps are shares of the diagonal of a box along the axes of space, which a turn changes.
  const auto steps_of = [](double step_mm, const Target& target) {
    const double share = step_mm / target.diagonal();
    return PropagationOptions{.first_step_share = share, .longest_step_share = share};
  };
  const Propagation here = propagate(*exact.target, line, 40.0, Vec3::UnitX(), steps_of(1.5, *exact.target));
  const Propagation there =
      propagate(*moved, {turn * line.tip + shift, turn * line.axis}, 40.0, turn * Vec3::UnitX(), steps_of(1.5, *moved));
  ASSERT_GT(here.steps, 8);
  for (std::size_t k = 0; k < 8; ++k)
    EXPECT_NEAR((turn * here.poses[k].tip + shift - there.poses[k].tip).norm(), 0.0, 1e-8);
}

}  // namespace
}  // namespace flank::internal
