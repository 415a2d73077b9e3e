#include "flank/envelope/path_regularity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flank/ruled_motion.h"
#include "motion/sample_motions.h"

namespace flank::internal {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

Path path_of(std::vector<Pose> poses) {
  Path path;
  path.strips.push_back({});
  path.strips.back().poses = std::move(poses);
  return path;
}

TEST(PathRegularity, WhatIsKnownSparesQuestionsAndChangesNothing) {
  const RadialFunction radial =
      RadialFunction::spline(20.0, (Eigen::VectorXd(6) << 3.0, 3.2, 3.6, 4.1, 4.2, 4.0).finished());
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const RuledMotion motion = testing::random_motion(seed);
    long asked = 0;
    const Touches touches = [&](const Vec3& centre, double) {
      return ++asked, std::fmod(std::abs(centre.sum()), 3.0) < 1.0;
    };
    double apart = 0.0, together = 0.0;
    for (int i = 0; i < 50; ++i)
      apart = std::max(apart, largest_c(motion.pose(i / 50.0), motion.pose((i + 1) / 50.0), radial, touches));
    const long all = asked;
    for (int i = 0; i < 50; ++i)
      together = largest_c(motion.pose(i / 50.0), motion.pose((i + 1) / 50.0), radial, touches, together);
    EXPECT_EQ(together, apart) << seed;
    EXPECT_LT(asked - all, all) << seed;
  }
}

TEST(PathRegularity, PosesAreAsDenseAsTheTurnAllows) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const RuledMotion motion = testing::random_motion(seed);
    SamplingOptions options;
    options.chord_tolerance_mm = 1.0;
    const SampledMotion coarse = sample_motion(motion, options);
    options.largest_turn_rad = 3.0 * kDegree;
    const SampledMotion fine = sample_motion(motion, options);
    EXPECT_GE(fine.poses.size(), coarse.poses.size());
    EXPECT_LE(fine.chord_bound_mm, coarse.chord_bound_mm);
    for (std::size_t i = 0; i + 2 < fine.poses.size(); ++i) {
      const Vec3 a = fine.poses[i + 1].tip - fine.poses[i].tip, b = fine.poses[i + 2].tip - fine.poses[i + 1].tip;
      if (std::min(a.norm(), b.norm()) > 1.0) {
        EXPECT_LT(std::atan2(a.cross(b).norm(), a.dot(b)), 6.0 * kDegree) << seed;
      }
    }
  }
}

TEST(PathRegularity, AConeThatMovesAlongItselfPlunges) {
  const RadialFunction cone(ToolFamily::kCone, 40.0, Eigen::Vector2d(3.0, 0.3));
  const Path across = path_of({{{0, 0, 0}, Vec3::UnitZ()}, {{1, 0, 0}, Vec3::UnitZ()}});
  const Path along = path_of({{{0, 0, 0}, Vec3::UnitZ()}, {{0.1, 0, -1}, Vec3::UnitZ()}});
  EXPECT_NEAR(largest_c(across, cone), 0.0, 1e-12);
  EXPECT_GT(largest_c(along, cone), 1.0);
}

TEST(PathRegularity, OnlyPlacesThatTouchCount) {
  // The axis turns about a point on itself: below it the cone goes one way, above it the other, and there it plunges.
  const RadialFunction cone(ToolFamily::kCone, 40.0, Eigen::Vector2d(3.0, 0.3));
  const Vec3 tilted = Vec3(0.05, 0.0, 1.0).normalized();
  const Vec3 centre(0.0, 0.0, 30.0);
  const Path path = path_of({{centre - 30.0 * Vec3::UnitZ(), Vec3::UnitZ()}, {centre - 30.05 * tilted, tilted}});
  EXPECT_GT(largest_c(path, cone), 1.0);
  EXPECT_LT(largest_c(path, cone, [](const Vec3& at, double) { return at.z() < 20.0; }), 0.1);
  EXPECT_EQ(largest_c(path, cone, [](const Vec3&, double) { return false; }), 0.0);
  // The ball of a place is inscribed there.
  const auto on_the_axis = [&](const Vec3& at, double radius) {
    EXPECT_LT(Vec3(at - centre).cross((Vec3::UnitZ() + tilted).normalized()).norm(), 0.1);
    const double s = 30.0 + (at.z() < 30.0 ? -1.0 : 1.0) * (at - centre).norm();
    EXPECT_NEAR(radius, cone.at(std::clamp(s, 0.0, 40.0)).r, 0.02);
    return true;
  };
  EXPECT_EQ(largest_c(path, cone, on_the_axis), largest_c(path, cone));
}

}  // namespace
}  // namespace flank::internal
