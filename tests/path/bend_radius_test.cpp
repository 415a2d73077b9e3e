// Bend radii of the two ends: closed forms of circles, of a turn on the spot, and of paths that do not bend.
#include "flank/path/bend_radius.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace flank::internal {
namespace {

constexpr double kLength = 30.0, kStill = 1e-4;

Path path_of(std::vector<Pose> poses) {
  Path path;
  path.strips.push_back({});
  path.strips.back().poses = std::move(poses);
  return path;
}

/// A cone about z whose tip runs on a circle of 10 mm and whose end on one of 10 + 30 sin(30 degrees).
std::vector<Pose> cone_poses(int count) {
  std::vector<Pose> poses;
  for (int k = 0; k < count; ++k) {
    // Uneven steps: the figure must not depend on where a path was sampled.
    const double a = 2.0 * std::pow(k / (count - 1.0), 1.5);
    const Vec3 out(std::cos(a), std::sin(a), 0.0);
    poses.push_back({10.0 * out, 0.5 * out + std::sqrt(0.75) * Vec3::UnitZ()});
  }
  return poses;
}

TEST(BendRadius, IsThatOfTheCirclesThatTheEndsRunOn) {
  const BendRadii radii = least_bend_radii(path_of(cone_poses(400)), kLength, kStill);
  EXPECT_NEAR(radii.tip_mm, 10.0, 1e-3);
  EXPECT_NEAR(radii.holder_end_mm, 25.0, 2e-3);
  EXPECT_EQ(radii.least_mm(), radii.tip_mm);
}

TEST(BendRadius, ConvergesWithTheSquareOfTheSpacing) {
  const double coarse = 10.0 - least_bend_radii(path_of(cone_poses(50)), kLength, kStill).tip_mm;
  const double fine = 10.0 - least_bend_radii(path_of(cone_poses(99)), kLength, kStill).tip_mm;
  EXPECT_GT(coarse, 0.0);
  EXPECT_NEAR(coarse / fine, 4.0, 0.4);
}

TEST(BendRadius, OfAStraightPathIsInfinite) {
  std::vector<Pose> poses;
  for (int k = 0; k < 9; ++k) poses.push_back({Vec3(k, 2.0 * k, 0.0), Vec3::UnitZ()});
  EXPECT_TRUE(std::isinf(least_bend_radii(path_of(poses), kLength, kStill).least_mm()));
  EXPECT_TRUE(std::isinf(least_bend_radii({}, kLength, kStill).least_mm()));
  poses.resize(2);
  EXPECT_TRUE(std::isinf(least_bend_radii(path_of(poses), kLength, kStill).least_mm()));
}

TEST(BendRadius, IsZeroWhereAnEndTurnsBack) {
  const BendRadii radii = least_bend_radii(
      path_of({{Vec3::Zero(), Vec3::UnitZ()}, {Vec3::UnitX(), Vec3::UnitZ()}, {Vec3::Zero(), Vec3::UnitZ()}}), kLength,
      kStill);
  EXPECT_NEAR(radii.tip_mm, 0.0, 1e-12);
}

TEST(BendRadius, OfAnEndThatStandsStillIsNotCounted) {
  // The tip trembles by less than is known of it, while the holder end runs on a circle of the axis' length.
  std::vector<Pose> poses;
  for (int k = 0; k < 60; ++k) {
    const double a = 0.05 * k;
    poses.push_back({Vec3(0.4 * kStill * (k % 2), 0.0, 0.0), Vec3(std::cos(a), std::sin(a), 0.0)});
  }
  const BendRadii radii = least_bend_radii(path_of(poses), kLength, kStill);
  EXPECT_TRUE(std::isinf(radii.tip_mm));
  EXPECT_NEAR(radii.holder_end_mm, kLength, 0.05);
}

TEST(BendRadius, OfStripsIsTheLeastOfEach) {
  Path path = path_of(cone_poses(400));
  path.strips.push_back(path.strips.front());
  // The way from the end of one strip to the begin of the next is none of a strip.
  const BendRadii one = least_bend_radii(path_of(cone_poses(400)), kLength, kStill);
  EXPECT_EQ(least_bend_radii(path, kLength, kStill).tip_mm, one.tip_mm);
}

}  // namespace
}  // namespace flank::internal
