// Ends of a side's motion that slide the tool along its own axis.
#include "flank/trochoid/sides/axial_ends.h"

#include <gtest/gtest.h>

#include <cmath>

namespace flank::internal {
namespace {

constexpr double kLength = 30.0, kWay = 40.0;

/// Along x as far as a wall, then up along its axis, `share` of the times.
RuledMotion before_wall(double share, double height) {
  std::vector<Pose> poses;
  std::vector<double> times;
  for (int i = 0; i <= 80; ++i) {
    const double t = i / 80.0, x = std::min(1.0, t / (1.0 - share));
    const double z = share > 0.0 ? height * std::max(0.0, t - 1.0 + share) / share : 0.0;
    poses.push_back({Vec3(kWay * x, 0.1 * x * x, z), Vec3(0.05 * x, 0.02, 1.0).normalized()});
    times.push_back(t);
  }
  return fit_motion(poses, times, kLength, 12);
}

TEST(AxialEnds, EndsBeforeTheToolSlidesAlongItsAxis) {
  const RuledMotion whole = before_wall(0.2, 10.0), part = without_axial_ends(whole);
  EXPECT_LT(std::abs(part.pose(1.0).tip.z()), 1.5);
  EXPECT_GT(part.pose(1.0).tip.x(), 0.93 * kWay);
  EXPECT_NEAR((part.pose(0.0).tip - whole.pose(0.0).tip).norm(), 0.0, 1e-12);
  // What is left is the same: its end is a place of the whole.
  double nearest = 1e300;
  for (int k = 0; k <= 4096; ++k) {
    const Pose pose = whole.pose(k / 4096.0), end = part.pose(1.0);
    nearest = std::min(nearest, (pose.tip - end.tip).norm() + (pose.axis - end.axis).norm());
  }
  EXPECT_LT(nearest, 1e-12);
}

TEST(AxialEnds, BeginsBehindIt) {
  RuledMotion whole = before_wall(0.2, 10.0);
  for (BSplineCurve3* rail : {&whole.tip, &whole.direction}) rail->poles = rail->poles.rowwise().reverse().eval();
  const RuledMotion part = without_axial_ends(whole);
  EXPECT_LT(std::abs(part.pose(0.0).tip.z()), 1.5);
  EXPECT_GT(part.pose(0.0).tip.x(), 0.93 * kWay);
}

TEST(AxialEnds, LeavesWhatHasNoneAndWhatIsAxialAllAlong) {
  for (const RuledMotion& motion : {before_wall(0.0, 0.0), before_wall(0.5, 60.0)}) {
    const RuledMotion same = without_axial_ends(motion);
    EXPECT_EQ(same.tip.poles, motion.tip.poles);
    EXPECT_EQ(same.direction.knots, motion.direction.knots);
  }
}

}  // namespace
}  // namespace flank::internal
