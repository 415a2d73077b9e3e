// A stretch of a motion has the poses of the whole.
#include "flank/motion/motion_part.h"

#include <gtest/gtest.h>

#include "flank/base/random.h"
#include "flank/ruled_motion.h"

namespace flank::internal {
namespace {

TEST(MotionPart, HasThePosesOfTheWhole) {
  Random random(5);
  std::vector<Pose> poses;
  std::vector<double> times;
  for (int i = 0; i <= 60; ++i) {
    times.push_back(i / 60.0);
    const double t = times.back();
    poses.push_back({Vec3(40.0 * t, 5.0 * t * t + 0.2 * random.normal(), 3.0), Vec3(0.3 * t, 0.2, 1.0).normalized()});
  }
  const RuledMotion whole = fit_motion(poses, times, 20.0, 12);
  const double first = 0.23, last = 0.871;
  const RuledMotion part = motion_part(whole, first, last);
  EXPECT_DOUBLE_EQ(part.tip.knots.front(), 0.0);
  EXPECT_DOUBLE_EQ(part.tip.knots.back(), 1.0);
  for (int i = 0; i <= 50; ++i) {
    const double t = i / 50.0, of_whole = first + (last - first) * t;
    EXPECT_LT((part.pose(t).tip - whole.pose(of_whole).tip).norm(), 1e-11) << t;
    EXPECT_LT((part.pose(t).axis - whole.pose(of_whole).axis).norm(), 1e-12) << t;
  }
}

}  // namespace
}  // namespace flank::internal
