// Beyond the ends of the sides: what goes on straight into the hub rises, and what is free is left as it is.
#include "flank/trochoid/run_out.h"

#include <gtest/gtest.h>

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
/// leans forward by a slope.
SidePath leaning(double y, double slope) {
  std::vector<Pose> poses;
  std::vector<double> t;
  for (int k = 0; k <= 40; ++k) {
    t.push_back(k / 40.0);
    poses.push_back({Vec3(5.0 + 40.0 * t.back(), y, kRadius + 0.05), Vec3(slope, 0.0, 1.0).normalized()});
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

TEST_F(RunOutTest, VelocitiesAreThoseOfThePlaces) {
  SidePath path = leaning(kRadius, 0.1);
  for (const bool end : {false, true}) {
    path.bend_run_out(end, Vec3(0.9, 0.3, 0.1).normalized(), 3.0);
    path.raise_run_out(end, Vec3(0.05, -0.02, 0.6), 1.3);
  }
  constexpr double kStep = 1e-5;
  for (const double beyond : {0.2, 1.1, 1.3 + 2.0 * kStep, 2.2, 5.0})
    for (const double x : {-beyond, path.length() + beyond}) {
      const Vec3 difference = (path.at(x + kStep).tip - path.at(x - kStep).tip) / (2.0 * kStep);
      EXPECT_LT((difference - path.at(x).tip_dx).norm(), 1e-6) << x;
    }
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
