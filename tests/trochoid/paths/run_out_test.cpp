// Beyond the ends of the sides: what goes on straight into the hub rises, and what is free is left as it is.
#include "flank/trochoid/paths/run_out.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "obstacle/obstacle_scene.h"

namespace flank::internal {
namespace {

using testing::hub;
using testing::only;
using testing::standing_blade;

constexpr double kRadius = 3.0, kLength = 30.0;
const RadialFunction kTool(ToolFamily::kCylinder, kLength, Eigen::VectorXd::Constant(1, kRadius));

/// Beside the plane y = 0, or 16 mm across from it, x from 5 to 55; the tip's ball is 0.05 mm above the hub, and the axis
/// leans forward by a slope; `ahead`: all of it so much farther on.
SidePath leaning(double y, double slope, double ahead = 0.0) {
  std::vector<Pose> poses;
  std::vector<double> t;
  for (int k = 0; k <= 40; ++k) {
    t.push_back(k / 40.0);
    poses.push_back({Vec3(5.0 + ahead + 40.0 * t.back(), y, kRadius + 0.05), Vec3(slope, 0.0, 1.0).normalized()});
  }
  return {fit_motion(poses, t, kLength, 8), false};
}

class RunOutTest : public ::testing::Test {
 protected:
  std::unique_ptr<Target> blade_ = standing_blade(0.0);
  ObstacleField hub_{only(hub(true)), *blade_, 2.0, 0.0};
  HalfGuard guard_{{{blade_.get()}, {&hub_}}, kTool};

  [[nodiscard]] double deepest(const SidePath& path) const {
    GuardDepth depth;
    for (double by = 0.5; by < 15.0; by += 0.5) {
      const AxisPlace place = path.at(path.length() + by);
      guard_.look({place.tip, place.u}, 5, depth);
    }
    return depth.deepest();
  }
};

TEST_F(RunOutTest, AreMotionsOfTheirOwnBesideTheSide) {
  SidePath a = leaning(kRadius, 0.17), b = leaning(19.0, 0.3);
  join_run_outs(a, b, kRadius);
  const double by = 1.5 * kRadius;
  const std::vector<RuledMotion> motions = a.motions_between(-by, a.length() + by);
  ASSERT_EQ(motions.size(), 3u);
  constexpr double kAlike = 1e-3;
  double from = -by;
  for (const double to : {0.0, a.length(), a.length() + by}) {
    const RuledMotion& motion = motions[from < 0.0 ? 0 : (to > a.length() ? 2 : 1)];
    for (const double t : {0.0, 0.3, 0.7, 1.0}) {
      const AxisPlace place = a.at(std::lerp(from, to, t));
      EXPECT_LT((motion.pose(t).at(0.0) - place.at(0.0)).norm(), kAlike) << to << " " << t;
      EXPECT_LT((motion.pose(t).at(kLength) - place.at(kLength)).norm(), kAlike) << to << " " << t;
    }
    from = to;
  }
  EXPECT_EQ(a.motions_between(1.0, 20.0).size(), 1u);
  a.stop_at(true);
  EXPECT_EQ(a.motions_between(1.0, a.length() + by).size(), 1u) << "there is a wall";
}

TEST_F(RunOutTest, RisesWhereTheHubIsInTheWay) {
  // Across an axis that leans forward means down.
  SidePath a = leaning(kRadius, 0.17), b = leaning(19.0, 0.17);
  join_run_outs(a, b, kRadius);
  EXPECT_GT(deepest(a), 1.0);
  join_run_outs(a, b, kRadius, guard_, 0.01);
  EXPECT_LE(deepest(a), 0.01);
  EXPECT_LE(deepest(b), 0.01);
}

TEST_F(RunOutTest, RisesAtOnceWhereTheFloorDoes) {
  // A floor that rises right behind the blade: what rises over a radius is too late.
  Face ramp = testing::quad(Vec3(46.5, -50, 0), Vec3(110, -50, 40), Vec3(46.5, 50, 0), Vec3(110, 50, 40), "F3");
  const ObstacleField rising(only({make_target({ramp}), true}), *blade_, 2.0, 0.0);
  const HalfGuard guard({{blade_.get()}, {&rising}}, kTool);
  SidePath a = leaning(kRadius, 0.0), b = leaning(19.0, 0.0);
  const auto deepest_of = [&](const SidePath& path) {
    GuardDepth depth;
    for (double by = 0.0; by < 15.0; by += 0.1) {
      const AxisPlace place = path.at(path.length() + by);
      guard.look({place.tip, place.u}, 9, depth);
    }
    return depth.deepest();
  };
  join_run_outs(a, b, kRadius);
  EXPECT_GT(deepest_of(a), 1.0);
  join_run_outs(a, b, kRadius, guard, 0.05);
  EXPECT_LE(deepest_of(a), 0.05);
  EXPECT_LE(deepest_of(b), 0.05);
}

TEST_F(RunOutTest, RisesNoHigherThanAHubThatEndsAsksFor) {
  // Down a slope, whose foot the blade's end lies above: what goes on as it came enters the foot, and beyond it nothing is in the way.
  const Face slope = testing::quad(Vec3(-20, -50, 12), Vec3(47, -50, 0), Vec3(-20, 50, 12), Vec3(47, 50, 0), "F3");
  const ObstacleField field(only({make_target({slope}), true}), *blade_, 2.0, 0.0);
  const HalfGuard guard({{blade_.get()}, {&field}}, kTool);
  const Vec3 normal = Vec3(12.0, 0.0, 67.0).normalized(), down = Vec3(67.0, 0.0, -12.0).normalized();
  const auto sinking = [&](double y) {
    std::vector<Pose> poses;
    std::vector<double> t;
    for (int k = 0; k <= 40; ++k) {
      t.push_back(k / 40.0);
      const Vec3 foot = Vec3(5.0, y, 12.0 - 12.0 / 67.0 * 25.0) + 40.0 * t.back() * down;
      poses.push_back({foot + (kRadius + 0.02) * normal, Vec3(0.35, 0.0, 1.0).normalized()});
    }
    return SidePath(fit_motion(poses, t, kLength, 8), false);
  };
  SidePath a = sinking(kRadius), b = sinking(19.0);
  EXPECT_EQ(join_run_outs(a, b, kRadius, guard, 0.01).end, 0.0);
  const double far = 20.0 * kRadius, middle = 0.5 * kLength;
  const AxisPlace end = a.at(a.length()), out = a.at(a.length() + far);
  const double risen = (out.at(middle) - end.at(middle)).dot(end.u);
  EXPECT_GT(risen, 0.01) << "it has to rise";
  EXPECT_LT(risen, kRadius) << "and needs to rise no more";
  EXPECT_NEAR((a.at(a.length() + far).tip_dx).dot(end.u), 0.0, 1e-9) << "level again";
}

TEST_F(RunOutTest, IsClearAsFarAsTheOtherSideGoes) {
  // One side begins 40 mm behind the other, and beside that a ramp begins, more than six radii before its own start.
  const Face ramp = testing::quad(Vec3(-40, -50, 5), Vec3(22, -50, 0), Vec3(-40, 50, 5), Vec3(22, 50, 0), "F3");
  const ObstacleField field(only({make_target({ramp}), true}), *blade_, 2.0, 0.0);
  const HalfGuard guard({{blade_.get()}, {&field}}, kTool);
  SidePath main = leaning(19.0, 0.0), splitter = leaning(kRadius, 0.0, 40.0);
  EXPECT_EQ(join_run_outs(main, splitter, kRadius, guard, 0.01).start, 0.0);
  GuardDepth depth;
  for (double by = 0.0; by <= 40.0 + 5.0 * kRadius; by += 0.25) {
    const AxisPlace place = splitter.at(-by);
    guard.look({place.tip, place.u}, 9, depth);
  }
  EXPECT_LE(depth.deepest(), 0.01);
}

TEST_F(RunOutTest, AWallAcrossTheWayIsToldApartFromAHub) {
  Face wall = testing::quad(Vec3(50, -50, 0), Vec3(50, 50, 0), Vec3(50, -50, 60), Vec3(50, 50, 60), "F3");
  for (const bool oriented : {true, false}) {
    const ObstacleField field(only({make_target({wall}), oriented}), *blade_, 2.0, 0.0);
    const HalfGuard guard({{blade_.get()}, {&field}}, kTool);
    SidePath a = leaning(kRadius, 0.0), b = leaning(19.0, 0.0);
    const RunOutDepth depth = join_run_outs(a, b, kRadius, guard, 0.01);
    EXPECT_EQ(depth.start, 0.0);
    EXPECT_GT(depth.end, 0.5 * kRadius);
    a.stop_at(true);
    EXPECT_LT(a.at(a.length() + 10.0).tip.x(), 50.0 - kRadius);
    EXPECT_EQ((a.at(a.length() + 10.0).tip - a.at(a.length()).tip).norm(), 0.0);
  }
  SidePath a = leaning(kRadius, 0.17), b = leaning(19.0, 0.17);
  EXPECT_EQ(join_run_outs(a, b, kRadius, guard_, 0.01).end, 0.0) << "the hub is risen from";
}

TEST_F(RunOutTest, TurnsAsideWhereABentChannelGoesOn) {
  // Straight on there is a wall that leaves room to one side: a channel that bends.
  const Face wall =
      testing::quad(Vec3(52, 19, -20), Vec3(112, -18.5, -20), Vec3(52, 19, 60), Vec3(112, -18.5, 60), "F3");
  const ObstacleField field(only({make_target({wall}), false}), *blade_, 2.0, 0.0);
  const HalfGuard guard({{}, {&field}}, kTool);
  SidePath a = leaning(kRadius, 0.0), b = leaning(14.0, 0.0);
  join_run_outs(a, b, kRadius);
  const auto deepest_of_both = [&] {
    GuardDepth depth;
    for (const SidePath* path : {&a, &b})
      for (double by = 0.0; by <= 6.0 * kRadius; by += 0.25) {
        const AxisPlace place = path->at(path->length() + by);
        guard.look({place.tip, place.u}, 9, depth);
      }
    return depth.deepest();
  };
  EXPECT_GT(deepest_of_both(), kWall * kRadius);
  EXPECT_LE(join_run_outs(a, b, kRadius, guard, 0.01).end, kWall * kRadius);
  EXPECT_LE(deepest_of_both(), kWall * kRadius);
}

TEST_F(RunOutTest, StepsInwardsWhereASideGoesOnPastTheEndOfItsPath) {
  // The side bulges right behind the end of its path, in its upper half: neither a hub to rise from nor a wall to turn along.
  const Face bulge = testing::quad(Vec3(45.5, 0, 15), Vec3(50, 0.3, 15), Vec3(45.5, 0, 60), Vec3(50, 0.3, 60), "F3");
  const ObstacleField field(only({make_target({bulge}), false}), *blade_, 2.0, 0.0);
  const HalfGuard guard({{blade_.get()}, {&field}}, kTool);
  SidePath a = leaning(kRadius, 0.0), b = leaning(19.0, 0.0);
  const auto deepest_of_first = [&] {
    GuardDepth depth;
    for (double by = 0.0; by <= 6.0 * kRadius; by += 0.25) {
      const AxisPlace place = a.at(a.length() + by);
      guard.look({place.tip, place.u}, 9, depth);
    }
    return depth.deepest();
  };
  join_run_outs(a, b, kRadius);
  EXPECT_GT(deepest_of_first(), 0.2);
  EXPECT_EQ(join_run_outs(a, b, kRadius, guard, 0.01).end, 0.0);
  EXPECT_LE(deepest_of_first(), 0.02);
  const AxisPlace p = a.at(a.length() + 12.0), q = b.at(b.length() + 12.0);
  EXPECT_LT((p.tip_dx - q.tip_dx).norm(), 1e-9) << "side by side again";
  EXPECT_GT((p.tip - q.tip).norm(), 16.0 - 2.0 * kRadius * 0.45) << "and hardly nearer to each other";
}

TEST_F(RunOutTest, GoesAsFarAsAWallThatIsFartherOn) {
  const Face wall = testing::quad(Vec3(56, -50, -20), Vec3(56, 50, -20), Vec3(56, -50, 60), Vec3(56, 50, 60), "F3");
  const ObstacleField field(only({make_target({wall}), true}), *blade_, 2.0, 0.0);
  const HalfGuard guard({{}, {&field}}, kTool);
  SidePath a = leaning(kRadius, 0.0), b = leaning(19.0, 0.0);
  const RunOutDepth depth = join_run_outs(a, b, kRadius, guard, 0.01);
  EXPECT_EQ(depth.free_start, std::numeric_limits<double>::infinity());
  EXPECT_GT(depth.end, kWall * kRadius);
  // Axes end at x = 45, and a tool of 3 mm gets up to 53.
  EXPECT_GT(depth.free_end, 2.0 * kRadius);
  EXPECT_LE(depth.free_end, 8.01);
  a.stop_at(true, depth.free_end);
  EXPECT_EQ(a.last(), a.length() + depth.free_end);
  EXPECT_LE(a.at(a.length() + 20.0).tip.x(), 53.01);
  EXPECT_EQ(a.motions_between(1.0, a.length() + 20.0).size(), 2u);
  EXPECT_EQ(a.poses(1.0, a.length() + 20.0, 0.01).back().tip, a.at(a.last()).tip);
}

/// The way was looked at in steps of up to 0.4 radii, and where it was shorter than a radius it was none: material was left before
/// the wall.
TEST_F(RunOutTest, TheWayToAWallIsFoundClosely) {
  for (const double x : {49.0, 52.5, 56.0}) {
    const Face wall = testing::quad(Vec3(x, -50, -20), Vec3(x, 50, -20), Vec3(x, -50, 60), Vec3(x, 50, 60), "F3");
    const ObstacleField field(only({make_target({wall}), true}), *blade_, 2.0, 0.0);
    const HalfGuard guard({{blade_.get()}, {&field}}, kTool);
    const SidePath path = leaning(kRadius, 0.0);
    // Axes end at x = 45.
    EXPECT_NEAR(way_to_wall(path, 0.0, kRadius * 3.0, guard, {0.01, 0.01}), x - kRadius - 45.0 + 0.01, 2e-3) << x;
  }
  const HalfGuard free({{blade_.get()}, {}}, kTool);
  EXPECT_EQ(way_to_wall(leaning(kRadius, 0.0), 0.4, kRadius, free, {0.01, 0.01}), 0.4) << "no wall is there";
}

TEST_F(RunOutTest, ASweepEndsBeforeWhatItsRunOutEnters) {
  // A rim behind the blade, so near that nothing rises in time.
  const Face rim =
      testing::quad(Vec3(48.05, -50, 0), Vec3(48.05, 50, 0), Vec3(48.05, -50, 2), Vec3(48.05, 50, 2), "F3");
  const ObstacleField field(only({make_target({rim}), true}), *blade_, 2.0, 0.0);
  const HalfGuard guard({{blade_.get()}, {&field}}, kTool);
  constexpr double kMost = 1.5 * kRadius, kAllowed = 0.02;
  const SidePath path = leaning(kRadius, 0.0);
  EXPECT_EQ(free_run_out(path, false, kMost, guard_, kAllowed), kMost) << "nothing is in the way there";
  const double way = free_run_out(path, true, kMost, guard, kAllowed);
  EXPECT_LT(way, 0.5 * kMost);
  GuardDepth depth;
  for (double by = 0.0; by <= way; by += 0.01) {
    const AxisPlace place = path.at(path.length() + by);
    guard.look({place.tip, place.u}, 13, depth);
  }
  EXPECT_LE(depth.deepest(), kAllowed);
}

TEST_F(RunOutTest, VelocitiesAreThoseOfThePlaces) {
  SidePath path = leaning(kRadius, 0.1);
  for (const bool end : {false, true}) {
    path.bend_run_out(end, Vec3(0.9, 0.3, 0.1).normalized(), 3.0);
    path.raise_run_out(end, Vec3(0.05, -0.02, 0.6), 1.3, 2.0);
    path.turn_run_out(end, Vec3(0.3, -0.5, 0.9).normalized(), 4.0);
  }
  constexpr double kStep = 1e-5;
  for (const double beyond : {0.2, 1.1, 1.3 + 2.0 * kStep, 2.2, 5.0})
    for (const double x : {-beyond, path.length() + beyond}) {
      const Vec3 difference = (path.at(x + kStep).tip - path.at(x - kStep).tip) / (2.0 * kStep);
      EXPECT_LT((difference - path.at(x).tip_dx).norm(), 1e-6) << x;
      const Vec3 turning = (path.at(x + kStep).u - path.at(x - kStep).u) / (2.0 * kStep);
      EXPECT_LT((turning - path.at(x).u_dx).norm(), 1e-6) << x;
    }
}

TEST_F(RunOutTest, AxesThatAreFarApartTurnToOneDirection) {
  const HalfGuard free({{blade_.get()}, {nullptr}}, kTool);
  const double far = 20.0 * kRadius;
  const double middle = 0.5 * kLength * 0.4 / std::hypot(1.0, 0.4);  // of a leaning axis, ahead of its tip
  SidePath a = leaning(kRadius, -0.4, middle), b = leaning(19.0, 0.4, -middle);
  const Vec3 back = a.at(0.0).u, forward = b.at(0.0).u;
  join_run_outs(a, b, kRadius, free, 0.01);
  for (const double x : {-far, a.length() + far}) {
    EXPECT_LT((a.at(x).u - b.at(x).u).norm(), 1e-9) << "side by side, they meet half way";
    EXPECT_NEAR(a.at(x).u.dot(back), a.at(x).u.dot(forward), 1e-6);
  }
  EXPECT_LT((a.at(0.0).u - back).norm(), 1e-9) << "the side itself is as it was";

  // The leaning side begins and ends far ahead: each run-out turns to the axis of the face that it lies beside.
  SidePath c = leaning(kRadius, 0.0), d = leaning(19.0, 0.8, 40.0);
  const Vec3 upright = c.at(0.0).u, tilted = d.at(0.0).u;
  join_run_outs(c, d, kRadius, free, 0.01);
  EXPECT_LT((d.at(-far).u - upright).norm(), 1e-6);
  EXPECT_LT((c.at(-far).u - upright).norm(), 1e-6);
  EXPECT_LT((c.at(c.length() + far).u - tilted).norm(), 1e-6);

  // What is hardly apart goes on straight.
  SidePath e = leaning(kRadius, 0.0), f = leaning(19.0, 0.2);
  join_run_outs(e, f, kRadius, free, 0.01);
  EXPECT_EQ((f.at(-far).u - f.at(0.0).u).norm(), 0.0);
}

TEST_F(RunOutTest, PosesFollowARunOutThatBendsRisesAndTurns) {
  constexpr double kChord = 0.005, kFar = 12.0;
  SidePath path = leaning(kRadius, 0.1);
  for (const bool end : {false, true}) {
    path.bend_run_out(end, Vec3(0.8, 0.6, 0.0), 3.0);
    path.raise_run_out(end, Vec3(0.0, 0.0, 0.7), 1.3, 2.0);
    path.turn_run_out(end, Vec3(0.0, 0.4, 0.9).normalized(), 8.0);
  }
  const std::vector<Pose> poses = path.poses(-kFar, path.length() + kFar, kChord);
  const auto apart = [&](const Vec3& p, double s) {
    double least = 1e9;
    for (std::size_t k = 1; k < poses.size(); ++k) {
      const Vec3 from = poses[k - 1].at(s), way = poses[k].at(s) - from;
      const double share = std::clamp((p - from).dot(way) / std::max(way.squaredNorm(), 1e-30), 0.0, 1.0);
      least = std::min(least, (from + share * way - p).norm());
    }
    return least;
  };
  for (const double by : {0.1, 0.7, 1.9, 3.3, 5.0, 7.7, 11.0})
    for (const double x : {-by, path.length() + by})
      for (const double s : {0.0, 0.5 * kLength, kLength})
        EXPECT_LT(apart(path.at(x).at(s), s), 1.2 * kChord) << x << ", s " << s;
}

TEST_F(RunOutTest, AnEdgeBetweenTwoPlacesOfASlenderToolIsSeen) {
  // A plate at z = 12.5 whose edge is 1 mm from the axis: 2 mm deep in the tool, between balls that are 5 mm apart.
  const Face plate =
      testing::quad(Vec3(1, -50, 12.5), Vec3(60, -50, 12.5), Vec3(1, 50, 12.5), Vec3(60, 50, 12.5), "F3");
  const ObstacleField field(only({make_target({plate}), false}), *blade_, 2.0, 0.0);
  const HalfGuard guard({{}, {&field}}, kTool);
  GuardDepth depth;
  guard.look({Vec3::Zero(), Vec3::UnitZ()}, 7, depth);
  EXPECT_GT(depth.others, 1.7);
  EXPECT_LT(depth.others, 2.0 + 1e-9);
}

TEST_F(RunOutTest, LeavesWhatIsFreeAsItIs) {
  SidePath a = leaning(kRadius + 1e-4, 0.0), b = leaning(19.0, 0.0), c = a, d = b;
  join_run_outs(a, b, kRadius);
  join_run_outs(c, d, kRadius, guard_, 0.01);
  for (const double x : {-12.0, -2.0, 53.0, 64.0}) {
    EXPECT_EQ(a.at(x).tip, c.at(x).tip) << x;
    EXPECT_EQ(b.at(x).tip, d.at(x).tip) << x;
  }
}

}  // namespace
}  // namespace flank::internal
