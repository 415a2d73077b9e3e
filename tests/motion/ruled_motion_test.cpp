#include "flank/ruled_motion.h"

#include <gtest/gtest.h>

#include "flank/error.h"
#include "motion/sample_motions.h"

namespace flank::internal {
namespace {

using testing::random_motion;
using testing::translation;

TEST(RuledMotion, IsRigid) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const RuledMotion motion = random_motion(seed);
    for (int i = 0; i <= 100; ++i) {
      const double t = i / 100.0;
      const AxisJet axis = motion.jet(t);
      EXPECT_NEAR(axis.u.norm(), 1.0, 4e-16);
      EXPECT_NEAR(axis.u.dot(axis.u_d1), 0.0, 1e-14);
      EXPECT_NEAR((motion.pose(t).at(40.0) - motion.pose(t).tip).norm(), 40.0, 2e-14 * 80.0);
      EXPECT_EQ(motion.pose(t).axis, axis.u);
    }
  }
}

TEST(RuledMotion, VelocityMatchesFiniteDifferences) {
  const double h = 1e-5;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const RuledMotion motion = random_motion(seed);
    for (const double t : {0.03, 0.2, 0.41, 0.5, 0.77, 0.98}) {
      for (const double s : {0.0, 13.0, 40.0}) {
        const Vec3 difference = (motion.pose(t + h).at(s) - motion.pose(t - h).at(s)) / (2.0 * h);
        EXPECT_LT((motion.jet(t).velocity(s) - difference).norm(), 1e-5) << "t = " << t << ", s = " << s;
      }
    }
  }
}

TEST(RuledMotion, LengthOfTheDirectionRailDoesNotMatter) {
  RuledMotion motion = random_motion(3);
  const AxisJet before = motion.jet(0.37);
  motion.direction.poles *= 2.5;
  const AxisJet after = motion.jet(0.37);
  EXPECT_LT((before.u - after.u).norm(), 1e-15);
  EXPECT_LT((before.u_d1 - after.u_d1).norm(), 1e-14);
}

TEST(FitMotion, ReproducesATranslation) {
  const RuledMotion motion = translation({1, 2, 3}, {60, 5, -4}, {0.2, -0.3, 0.9}, 35.0);
  EXPECT_EQ(motion.axis_length, 35.0);
  for (const double t : {0.0, 0.13, 0.5, 1.0}) {
    EXPECT_LT((motion.pose(t).tip - (Vec3(1, 2, 3) + t * Vec3(60, 5, -4))).norm(), 1e-9);
    EXPECT_LT((motion.jet(t).velocity(10.0) - Vec3(60, 5, -4)).norm(), 1e-7);
  }
}

TEST(FitMotion, ConvergesWithTheFourthPowerOfTheSpacing) {
  const auto pose_at = [](double t) {
    return Pose{Vec3(70 * t, 10 * std::sin(3 * t), 5 * std::cos(2 * t)),
                Vec3(std::sin(t), 0.3, std::cos(t)).normalized()};
  };
  std::vector<Pose> poses;
  std::vector<double> t;
  for (int i = 0; i <= 400; ++i) poses.push_back(pose_at(t.emplace_back(i / 400.0)));
  const auto error = [&](int count) {
    const RuledMotion motion = fit_motion(poses, t, 40.0, count);
    double worst = 0.0;
    for (std::size_t i = 0; i < t.size(); ++i)
      worst = std::max(worst, (motion.pose(t[i]).at(40.0) - poses[i].at(40.0)).norm());
    return worst;
  };
  const double coarse = error(11), fine = error(19);  // 8 and 16 spans
  EXPECT_GT(coarse / fine, 10.0);
  EXPECT_LT(fine, 1e-3);
}

TEST(FitMotion, RefusesTooFewPoses) {
  const std::vector<Pose> poses(3);
  const std::vector<double> t{0.0, 0.5, 1.0};
  EXPECT_THROW((void)fit_motion(poses, t, 10.0, 4), InternalError);
  EXPECT_THROW((void)fit_motion(poses, {0.0, 1.0}, 10.0, 3), InternalError);
}

}  // namespace
}  // namespace flank::internal
