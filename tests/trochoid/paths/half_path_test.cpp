// Half paths: where they begin and end, how they leave, and that nothing but the axis' position changes.
#include "flank/trochoid/paths/half_path.h"

#include <gtest/gtest.h>

#include <cmath>

#include "flank/trochoid/paths/run_out.h"
#include "flank/trochoid/paths/side_path.h"

namespace flank::internal {
namespace {

RuledMotion bent_side(double y, double sign) {
  std::vector<Pose> poses;
  std::vector<double> t;
  for (int k = 0; k <= 60; ++k) {
    t.push_back(k / 60.0);
    const double x = 50.0 * t.back();
    poses.push_back({Vec3(x, y + sign * 0.004 * (x - 25.0) * (x - 25.0), 0.0),
                     Vec3(0.02, sign * (0.1 - 0.002 * x), 1.0).normalized()});
  }
  return fit_motion(poses, t, 30.0, 12);
}

TEST(HalfPath, LeavesForwardAndArrivesBackward) {
  const SidePath a(bent_side(0.0, 1.0), false), b(bent_side(16.0, -1.0), false);
  const AxisPlace from = a.at(20.0), to = b.at(22.0);
  const RuledMotion half = half_path(30.0, from, to.reversed(), {2.0, 1.5, 1.0, 0.0});
  const AxisJet start = half.jet(0.0), end = half.jet(1.0);
  for (const double s : {0.0, 12.0, 30.0}) {
    EXPECT_NEAR((start.at(s) - from.at(s)).norm(), 0.0, 1e-12);
    EXPECT_NEAR((end.at(s) - to.at(s)).norm(), 0.0, 1e-12);
    // The same velocity up to one factor for the whole axis: 9 handles a unit of time.
    EXPECT_NEAR((start.velocity(s) - 18.0 * from.velocity(s)).norm(), 0.0, 1e-9);
    EXPECT_NEAR((end.velocity(s) + 13.5 * to.velocity(s)).norm(), 0.0, 1e-9);
  }
}

TEST(HalfPath, BulgesForwardAndLiftsAlongTheAxis) {
  const SidePath a(bent_side(0.0, 1.0), false), b(bent_side(16.0, -1.0), false);
  const AxisPlace from = a.at(20.0), to = b.at(20.0);
  const auto middle = [&](double bulge, double lift) {
    return half_path(30.0, from, to.reversed(), {2.0, 2.0, bulge, lift}).pose(0.5).at(15.0);
  };
  EXPECT_GT((middle(3.0, 0.0) - middle(0.0, 0.0)).x(), 2.0);
  EXPECT_GT((middle(0.0, 2.0) - middle(0.0, 0.0)).z(), 1.0);
}

/// Before a wall a half has little room ahead: it goes on being tangential, or the tool would be in a corner that is as round as itself.
TEST(HalfPath, BeforeAWallItTurnsInCornersAsRoundAsTheRoomIs) {
  const SidePath a(bent_side(0.0, 1.0), false), b(bent_side(16.0, -1.0), false);
  const AxisPlace from = a.at(20.0), to = b.at(20.0).reversed();
  const HalfShape shape{3.0, 3.0, 2.0, 0.0};
  for (const double room : {2.0, 1.0, 0.5}) {
    const RuledMotion half = half_before_wall(30.0, from, to, shape, room, room);
    EXPECT_NEAR(reach_ahead(half, from, to), room, 0.06 * room) << room;
    const AxisJet start = half.jet(0.0), end = half.jet(1.0);
    EXPECT_GT(start.velocity(15.0).normalized().dot(from.velocity(15.0).normalized()), 1.0 - 1e-12);
    EXPECT_GT(end.velocity(15.0).normalized().dot(to.velocity(15.0).normalized()), 1.0 - 1e-12);
    double sharpest = 0.0;
    for (int k = 0; k < 4000; ++k) {
      const AxisJet jet = half.jet(k / 4000.0), next = half.jet((k + 1) / 4000.0);
      const double angle =
          std::acos(std::min(1.0, jet.velocity(15.0).normalized().dot(next.velocity(15.0).normalized())));
      sharpest = std::max(sharpest, angle / (next.at(15.0) - jet.at(15.0)).norm());
    }
    EXPECT_LT(sharpest, 1.7 / room) << "nearly as round as a quarter of a circle";
  }
}

/// A floor that rises ahead of the sides is entered just off the ends, where the inner points hardly lift the tip.
TEST(HalfPath, ALiftKeepsTheTipOffAFloorThatRisesFromTheEnds) {
  const double slope = 0.1, gap = 9.0, handle = 1.4;
  const auto place = [](double y) { return AxisPlace{Vec3(0, y, 0), Vec3::UnitZ(), Vec3::UnitX(), Vec3::Zero()}; };
  const auto deepest = [&](double lift) {
    const RuledMotion half = half_path(20.0, place(0.0), place(gap).reversed(), {handle, handle, 1.0, lift});
    double deep = 0.0;
    for (int k = 0; k <= 1000; ++k) {
      const Vec3 tip = half.pose(k / 1000.0).tip;
      deep = std::max(deep, slope * tip.x() - tip.z());
    }
    return deep;
  };
  EXPECT_GT(deepest(0.0), 0.2);
  EXPECT_LT(deepest(1.0), 1e-3);
  // Nothing of a lift turns the axis, or moves the ends.
  const RuledMotion half = half_path(20.0, place(0.0), place(gap).reversed(), {handle, handle, 1.0, 1.0});
  EXPECT_EQ((half.pose(0.3).axis - Vec3::UnitZ()).norm(), 0.0);
  EXPECT_EQ(half.pose(1.0).tip.z(), 0.0);
  EXPECT_EQ(half.jet(0.0).velocity(5.0).y(), 0.0);
}

TEST(HalfPath, ReachesAheadByTheShareThatIsLeft) {
  const SidePath a(bent_side(0.0, 1.0), false), b(bent_side(16.0, -1.0), false);
  const AxisPlace from = a.at(20.0), to = b.at(20.0).reversed();
  const HalfShape shape{2.0, 2.0, 1.5, 0.0};
  const double reach = reach_ahead(half_path(30.0, from, to, shape), from, to);
  EXPECT_GT(reach, 1.0);
  for (const double share : {1.0, 0.5, 0.2, 0.0}) {
    const RuledMotion less = half_path_across(30.0, from, to, shape, share, share);
    EXPECT_NEAR(reach_ahead(less, from, to), share * reach, 0.02 * reach) << share;
    EXPECT_LT((less.pose(0.0).tip - from.tip).norm(), 1e-12);
    EXPECT_LT((less.pose(1.0).tip - to.tip).norm(), 1e-12);
  }
}

TEST(SidePath, StaysWhereItIsBeyondAWall) {
  SidePath path(bent_side(0.0, 1.0), false);
  path.stop_at(false);
  EXPECT_TRUE(path.stops_at_start());
  EXPECT_FALSE(path.stops_at_end());
  EXPECT_EQ((path.at(-3.0).tip - path.at(0.0).tip).norm(), 0.0);
  EXPECT_GT((path.at(path.length() + 3.0).tip - path.at(path.length()).tip).norm(), 2.9);
}

TEST(SidePath, APartOfItsMotionIsTheSameMotion) {
  const SidePath path(bent_side(0.0, 1.0), false);
  const RuledMotion part = path.motion_between(7.0, 31.0);
  EXPECT_LT((part.pose(0.0).tip - path.at(7.0).tip).norm(), 1e-9);
  EXPECT_LT((part.pose(1.0).tip - path.at(31.0).tip).norm(), 1e-9);
  EXPECT_NEAR(way_of_middle(part), 24.0, 0.01);
  EXPECT_EQ(path.motion_between(-1.0, 1e9).tip.knots, path.motion().tip.knots);
}

TEST(SidePath, GoesByTheWayOfTheMiddle) {
  const SidePath path(bent_side(0.0, 1.0), false);
  for (const double x : {3.0, 21.0, 44.0}) {
    const double h = 1e-3;
    EXPECT_NEAR((path.at(x + h).at(15.0) - path.at(x - h).at(15.0)).norm(), 2.0 * h, 2e-5);
    EXPECT_NEAR(path.at(x).velocity(15.0).norm(), 1.0, 1e-12);
  }
}

TEST(SidePath, RunsOutWithoutAJump) {
  SidePath a(bent_side(0.0, 1.0), false), b(bent_side(16.0, -1.0), false);
  join_run_outs(a, b, 6.0);
  for (const SidePath* path : {&a, &b}) {
    for (const double x : {0.0, path->length()}) {
      const AxisPlace before = path->at(x - 1e-7), after = path->at(x + 1e-7);
      EXPECT_NEAR((before.at(15.0) - after.at(15.0)).norm(), 0.0, 1e-6);
      EXPECT_NEAR((before.velocity(15.0) - after.velocity(15.0)).norm(), 0.0, 1e-5);
    }
  }
  const auto gap = [&](double x) { return (a.at(x).at(15.0) - b.at(x).at(15.0)).norm(); };
  EXPECT_NEAR(gap(-20.0), gap(-8.0), 1e-6) << "they would meet if they went straight on";
  EXPECT_NEAR((a.at(-20.0).velocity(15.0) - b.at(-20.0).velocity(15.0)).norm(), 0.0, 1e-9);
}

TEST(SidePath, BackwardsIsTheSameWay) {
  const SidePath on(bent_side(0.0, 1.0), false), back(bent_side(0.0, 1.0), true);
  EXPECT_NEAR(on.length(), back.length(), 1e-9);
  EXPECT_NEAR((on.at(10.0).tip - back.at(back.length() - 10.0).tip).norm(), 0.0, 1e-4);
}

}  // namespace
}  // namespace flank::internal
