// One whole cover, small enough for the sanitizers: a plane of 24 x 16 mm, a cylinder 10 mm long, a few seeds.
#include <gtest/gtest.h>

#include <cmath>

#include "cover/cover_targets.h"
#include "flank/cover.h"
#include "flank/threads.h"

namespace flank::internal {
namespace {

class SmallCover : public ::testing::Test {
 protected:
  SmallCover() {
    options_.tolerance_mm = 0.02;
    options_.seed_places = 2;
    options_.seed_directions = 2;
    options_.seed_spheres = 1;
    options_.sample_share = 0.06;
    options_.dense_share = 0.05;
    options_.control_points = 8;
    options_.most_strips = 3;
  }
  CoverResult run(const Obstacles& obstacles = {}, int threads = 0) const {
    set_thread_count(threads);
    CoverResult result = cover(*target_, tool_, obstacles, options_, {});
    set_thread_count(0);
    return result;
  }
  /// Share of points of the plane that the poses of all strips leave within the tolerance, from their closed form.
  double covered(const std::vector<RuledMotion>& motions) const {
    constexpr int kSteps = 30, kPoses = 200;
    int within = 0;
    for (int i = 0; i < kSteps; ++i) {
      for (int j = 0; j < kSteps; ++j) {
        const Vec3 x(24.0 * (i + 0.5) / kSteps, 16.0 * (j + 0.5) / kSteps, 0.0);
        double least = 1e300;
        for (const RuledMotion& motion : motions)
          for (int k = 0; k <= kPoses; ++k) {
            const Pose pose = motion.pose(static_cast<double>(k) / kPoses);
            const double s = std::clamp(pose.axis.dot(x - pose.tip), 0.0, kLength);
            least = std::min(least, (x - pose.at(s)).norm() - kRadius);
          }
        if (std::abs(least) <= options_.tolerance_mm) ++within;
      }
    }
    return within / static_cast<double>(kSteps * kSteps);
  }

  static constexpr double kRadius = 3.0, kLength = 10.0;
  std::unique_ptr<Target> target_ = testing::flat_target(0.0, 24.0, 0.0, 16.0);
  Tool tool_ = testing::cylinder(kRadius, kLength);
  CoverOptions options_;
};

TEST_F(SmallCover, CoversThePlaneInTwoOrThreeStripsWithinTolerance) {
  const CoverResult result = run();
  ASSERT_EQ(result.status, CoverStatus::kCovered) << result.message;
  EXPECT_GE(result.coverage, 0.97);
  EXPECT_GE(result.motions.size(), 2u) << "16 mm are more than the tool is long";
  EXPECT_LE(result.motions.size(), 3u);
  EXPECT_LE(result.overcut_mm, options_.tolerance_mm);
  EXPECT_EQ(result.reachable, 1.0);
  EXPECT_GT(result.seeds, 0);
  EXPECT_GE(result.grown, static_cast<int>(result.motions.size()));
  EXPECT_NEAR(covered(result.motions), result.coverage, 0.05) << "what it says is what the poses do";
  for (const RuledMotion& motion : result.motions) EXPECT_EQ(motion.axis_length, kLength);
}

TEST_F(SmallCover, SameBytesForAnyNumberOfThreads) {
  options_.smooth = false;
  const CoverResult one = run({}, 1), three = run({}, 3);
  ASSERT_FALSE(one.motions.empty());
  ASSERT_EQ(one.motions.size(), three.motions.size());
  EXPECT_EQ(one.coverage, three.coverage);
  for (std::size_t k = 0; k < one.motions.size(); ++k) {
    EXPECT_EQ(one.motions[k].tip.poles, three.motions[k].tip.poles);
    EXPECT_EQ(one.motions[k].direction.poles, three.motions[k].direction.poles);
  }
}

TEST_F(SmallCover, NoStripEntersAWall) {
  options_.smooth = false;
  const Obstacles wall = testing::wall_at(16.0);
  const CoverResult result = run(wall);
  ASSERT_EQ(result.status, CoverStatus::kCovered) << result.message;
  EXPECT_NEAR(result.reachable, 13.0 / 16.0, 0.05) << "a ball of 3 mm keeps its radius from the wall";
  EXPECT_GE(result.coverage, 0.9);
  const PoseChecker checker(tool_, wall.meshes);
  for (const RuledMotion& motion : result.motions)
    for (int i = 0; i <= 400; ++i) EXPECT_TRUE(checker.is_free(motion.pose(i / 400.0), -options_.tolerance_mm));
}

TEST_F(SmallCover, AHighPriceLeavesOneStrip) {
  options_.smooth = false;
  options_.strip_price = 0.45;
  const CoverResult result = run();
  ASSERT_EQ(result.status, CoverStatus::kCovered) << result.message;
  EXPECT_EQ(result.motions.size(), 1u);
  EXPECT_EQ(result.overlap, 0.0);
}

}  // namespace
}  // namespace flank::internal
