#include <gtest/gtest.h>

#include "flank/error.h"
#include "flank/ruled_motion.h"
#include "motion/sample_motions.h"

namespace flank::internal {
namespace {

using testing::random_motion;
using testing::translation;

/// Largest distance between the motion and its poses joined as a controller joins them, at both ends of the axis.
double dense_error(const RuledMotion& motion, const SampledMotion& sampled, int per_step) {
  double worst = 0.0;
  for (std::size_t i = 1; i < sampled.t.size(); ++i) {
    const Pose &a = sampled.poses[i - 1], &b = sampled.poses[i];
    for (int k = 0; k <= per_step; ++k) {
      const double x = static_cast<double>(k) / per_step;
      const Pose joined{(1.0 - x) * a.tip + x * b.tip, ((1.0 - x) * a.axis + x * b.axis).normalized()};
      const Pose exact = motion.pose((1.0 - x) * sampled.t[i - 1] + x * sampled.t[i]);
      worst = std::max(worst, (joined.tip - exact.tip).norm());
      worst = std::max(worst, (joined.at(motion.axis_length) - exact.at(motion.axis_length)).norm());
    }
  }
  return worst;
}

TEST(SampleMotion, BoundHoldsOnADenseCheck) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    for (const double tolerance : {1.0, 1e-2, 1e-4}) {
      const RuledMotion motion = random_motion(seed);
      const SampledMotion sampled = sample_motion(motion, {.chord_tolerance_mm = tolerance});
      EXPECT_LE(sampled.chord_bound_mm, tolerance);
      EXPECT_LE(dense_error(motion, sampled, 8), sampled.chord_bound_mm * (1.0 + 1e-9) + 1e-12);
      EXPECT_EQ(sampled.t.front(), 0.0);
      EXPECT_EQ(sampled.t.back(), 1.0);
      EXPECT_EQ(sampled.poses.size(), sampled.t.size());
    }
  }
}

TEST(SampleMotion, BoundIsNotWasteful) {
  const RuledMotion motion = random_motion(4);
  const SampledMotion sampled = sample_motion(motion, {.chord_tolerance_mm = 1e-3});
  EXPECT_GT(dense_error(motion, sampled, 8), 0.3e-3);
}

TEST(SampleMotion, StepsAreWiderWhereTheMotionIsStraight) {
  RuledMotion motion = translation({0, 0, 0}, {80, 0, 0}, {0, 0, 1}, 40.0);
  motion.tip.poles(1, 5) += 6.0;  // bends the end only
  const SampledMotion sampled = sample_motion(motion, {.chord_tolerance_mm = 1e-4});
  ASSERT_GT(sampled.t.size(), 10u);
  EXPECT_GT(sampled.t[1] - sampled.t[0], 5.0 * (sampled.t.back() - sampled.t[sampled.t.size() - 2]));
}

TEST(SampleMotion, ATranslationNeedsTwoPoses) {
  const RuledMotion motion = translation({0, 0, 0}, {80, 10, 0}, {0, 0.2, 1}, 40.0);
  const SampledMotion sampled = sample_motion(motion, {.chord_tolerance_mm = 1e-6});
  EXPECT_EQ(sampled.poses.size(), 2u);
  EXPECT_EQ(sample_motion(motion, {.chord_tolerance_mm = 1e-6, .minimum_poses = 30}).poses.size(), 30u);
}

TEST(SampleMotion, SaysWhatItReachesWhenThePosesRunOut) {
  const RuledMotion motion = random_motion(6);
  const SamplingOptions options{.chord_tolerance_mm = 1e-6, .minimum_poses = 2, .maximum_poses = 100};
  const SampledMotion sampled = sample_motion(motion, options);
  EXPECT_LE(sampled.poses.size(), 100u);
  EXPECT_GT(sampled.poses.size(), 60u);
  EXPECT_GT(sampled.chord_bound_mm, 1e-6);
  EXPECT_LE(dense_error(motion, sampled, 8), sampled.chord_bound_mm);
}

TEST(SampleMotion, RefusesOptionsThatMakeNoSense) {
  const RuledMotion motion = random_motion(1);
  EXPECT_THROW((void)sample_motion(motion, {.chord_tolerance_mm = 0.0}), UsageError);
  EXPECT_THROW((void)sample_motion(motion, {.chord_tolerance_mm = -1.0}), UsageError);
  EXPECT_THROW((void)sample_motion(motion, {.minimum_poses = 1}), UsageError);
  EXPECT_THROW((void)sample_motion(motion, {.minimum_poses = 10, .maximum_poses = 5}), UsageError);
}

TEST(SampleMotion, ReportsARailThatVanishes) {
  RuledMotion motion = random_motion(1);
  motion.direction.poles.rightCols(5) *= -1.0;
  motion.direction.poles.row(0).setZero();
  motion.direction.poles.row(1).setZero();
  EXPECT_THROW((void)sample_motion(motion, {}), InternalError);
}

}  // namespace
}  // namespace flank::internal
