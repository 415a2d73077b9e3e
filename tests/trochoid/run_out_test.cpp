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
  HalfGuard guard_{{{blade_.get()}, {&hub_}},
                   RadialFunction(ToolFamily::kCylinder, kLength, Eigen::VectorXd::Constant(1, kRadius))};

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
