// The local search for a movable line: against sampling, within its radius, and idle if there is nothing to gain.
#include "flank/seed/line_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "flank/base/random.h"
#include "seed/exact_targets.h"
#include "seed/sheet.h"

namespace flank::internal {
namespace {

using testing::ExactTarget;
using testing::pose_off;

/// Lines whose ends are shifted across the axis, as the search counts them: rigid, about the middle.
Pose shifted(const Pose& start, double length, const Vec2& tip, const Vec2& holder) {
  const Vec3 e1 = start.axis.unitOrthogonal(), e2 = start.axis.cross(e1);
  const Vec3 a = start.tip + tip.x() * e1 + tip.y() * e2, b = start.at(length) + holder.x() * e1 + holder.y() * e2;
  const Vec3 u = (b - a).normalized();
  return {0.5 * (a + b) - 0.5 * length * u, u};
}

/// The least movability over a grid of both ends' shifts within the radius.
double least_sampled(const Target& target, const Pose& start, double length, double radius) {
  std::vector<Vec2> shifts;
  for (int i = -2; i <= 2; ++i)
    for (int j = -2; j <= 2; ++j)
      if (i * i + j * j <= 4) shifts.emplace_back(0.5 * radius * i, 0.5 * radius * j);
  double least = 1e300;
  for (const Vec2& tip : shifts)
    for (const Vec2& holder : shifts)
      least = std::min(least, movability(target, shifted(start, length, tip, holder), length).value);
  return least;
}

constexpr double kShort = 24.0;

/// The middle of the axis of an exact target, whose footpoints are all inside, with its ends off by a share of the
/// diagonal in opposite directions.
Pose off_by(const ExactTarget& exact, double t, double share) {
  const double d = share * exact.target->diagonal();
  const Pose whole = exact.motion.pose(t);
  return pose_off({whole.at(8.0), whole.axis}, kShort, d * Vec3(0.6, 0.5, 0.0), d * Vec3(-0.5, -0.6, 0.0));
}

TEST(LineSearch, IsNoWorseThanTheBestOfManySamples) {
  for (const ExactTarget& exact : {testing::barrel_target(), testing::cone_target()}) {
    const Pose start = off_by(exact, 0.5, 0.005);
    const LineSearch search = search_line(*exact.target, start, kShort);
    ASSERT_EQ(search.before.weight, 1.0);
    const double sampled = least_sampled(*exact.target, start, kShort, 0.01 * exact.target->diagonal());
    ASSERT_LT(sampled, search.before.value) << "there is something to gain";
    EXPECT_LE(search.after.value, sampled + 1e-15);
  }
}

TEST(LineSearch, WhatItReportsIsTheMovabilityOfItsLine) {
  // A sheet with waves, on which no line moves exactly.
  const auto wavy = [](double u, double v) {
    return Vec3(60.0 * u, 40.0 * v, 1.5 * std::sin(5.0 * u + 0.3) * std::cos(40.0 / 15.0 * v));
  };
  const auto target = make_target({testing::sheet(wavy, 25, 21)});
  const Pose start{Vec3(42.0, 8.0, 6.0), Vec3(0.05, 1.0, 0.05).normalized()};
  const LineSearch search = search_line(*target, start, kShort);
  EXPECT_NEAR(movability(*target, start, kShort).value, search.before.value, 1e-6 * search.before.value);
  MovabilityOptions same_way;
  same_way.previous = search.before.velocity.middle;
  const Movability after = movability(*target, search.pose, kShort, 24, same_way);
  EXPECT_NEAR(after.value, search.after.value, 1e-6 * search.before.value);
  EXPECT_LT(after.value, 0.6 * search.before.value);
  EXPECT_NEAR(search.pose.axis.norm(), 1.0, 1e-12);
  const double tip = (search.pose.tip - start.tip).norm(), holder = (search.pose.at(kShort) - start.at(kShort)).norm();
  EXPECT_NEAR(std::max(tip, holder), search.shift_mm, 0.02 * search.shift_mm);
  EXPECT_GT(search.evaluations, 9) << "the first value and one set of differences at least";
}

TEST(LineSearch, LeavesALineThatIsExactAlone) {
  const ExactTarget exact = testing::plane_target();
  const Pose start = exact.motion.pose(0.5);
  const LineSearch search = search_line(*exact.target, start, 30.0);
  EXPECT_EQ(search.evaluations, 1);
  EXPECT_EQ(search.shift_mm, 0.0);
  EXPECT_NEAR((search.pose.tip - start.tip).norm(), 0.0, 1e-12);
  EXPECT_NEAR((search.pose.axis - start.axis).norm(), 0.0, 1e-12);
  EXPECT_EQ(search.after.value, search.before.value);
}

TEST(LineSearch, NoIterationsChangeNothing) {
  const ExactTarget exact = testing::cone_target();
  const Pose start = off_by(exact, 0.5, 0.01);
  const LineSearch search = search_line(*exact.target, start, kShort, {.iterations = 0});
  EXPECT_NEAR((search.pose.tip - start.tip).norm(), 0.0, 1e-12);
  EXPECT_EQ(search.after.value, search.before.value);
  EXPECT_EQ(search.evaluations, 1);
}

TEST(LineSearch, NeitherEndLeavesItsRadius) {
  const ExactTarget exact = testing::barrel_target();
  for (const double share : {1e-4, 1e-3, 5e-3}) {
    const Pose start = off_by(exact, 0.5, 0.02);
    const LineSearch search = search_line(*exact.target, start, kShort, {.radius_share = share});
    const double radius = share * exact.target->diagonal();
    EXPECT_LE(search.shift_mm, radius * (1.0 + 1e-9));
    EXPECT_GT(search.shift_mm, 0.5 * radius) << "the line is farther off than that: it goes as far as it may";
    EXPECT_LE((search.pose.tip - start.tip).norm(), 1.01 * radius);
    EXPECT_LE((search.pose.at(kShort) - start.at(kShort)).norm(), 1.01 * radius);
    EXPECT_LT(search.after.value, search.before.value);
  }
}

TEST(LineSearch, NeverEndsWorseThanItStarts) {
  Random random(19);
  const ExactTarget exact = testing::cone_target();
  for (int k = 0; k < 20; ++k) {
    const auto shift = [&] { return Vec3(random.uniform(-4, 4), random.uniform(-4, 4), random.uniform(-4, 4)); };
    const Pose start = pose_off(exact.motion.pose(random.uniform()), 40.0, shift(), shift());
    const LineSearch search = search_line(*exact.target, start, 40.0, {.iterations = 4, .radius_share = 0.05});
    EXPECT_LE(search.after.value, search.before.value);
    EXPECT_GE(search.after.weight, search.before.weight - 1e-8);
  }
}

TEST(LineSearch, MovesWithItsTarget) {
  const Eigen::AngleAxisd turn(0.9, Vec3(-0.2, 0.9, 0.4).normalized());
  const Vec3 shift(30.0, 5.0, -60.0);
  const ExactTarget exact = testing::barrel_target();
  const auto moved = make_target({testing::moved(exact.face, turn, shift)});
  const Pose start = off_by(exact, 0.5, 0.005);
  // The radius is a share of the diagonal of a box along the axes of space, which a turn changes.
  const LineSearch here =
      search_line(*exact.target, start, kShort, {.iterations = 2, .radius_share = 0.5 / exact.target->diagonal()});
  const LineSearch there = search_line(*moved, {turn * start.tip + shift, turn * start.axis}, kShort,
                                       {.iterations = 2, .radius_share = 0.5 / moved->diagonal()});
  EXPECT_NEAR(here.before.value, there.before.value, 1e-5 * here.before.value);
  EXPECT_NEAR(here.after.value, there.after.value, 1e-4 * here.before.value);
  EXPECT_NEAR((turn * here.pose.tip + shift - there.pose.tip).norm(), 0.0, 1e-2 * here.shift_mm);
}

}  // namespace
}  // namespace flank::internal
