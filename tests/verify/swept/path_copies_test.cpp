// Copies of a path: found where there are any, and searched as if all of them were in one tree.
#include "flank/verify/swept/path_copies.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "flank/judge.h"
#include "verify/brute_force.h"

namespace flank::internal::verify {
namespace {

constexpr double kLength = 20.0;
constexpr int kSectors = 7;

/// Three strips beside each other, turned about an axis that goes through no corner of the room, as many times.
Path wheel_path(double wrong_mm) {
  Random random(3);
  const Eigen::Isometry3d turn =
      Eigen::Translation3d(3.0, -2.0, 1.0) *
      Eigen::AngleAxisd(2.0 * std::numbers::pi / kSectors, Vec3(0.2, 0.1, 1.0).normalized()) *
      Eigen::Translation3d(-3.0, 2.0, -1.0);
  Path path, sector;
  for (int k = 0; k < 3; ++k) sector.strips.push_back(brute::twisted_path(random, 9 + k, 12.0, 0.6).strips[0]);
  for (Strip& strip : sector.strips)
    for (Pose& pose : strip.poses) pose.tip += Vec3(30.0, 0.0, 0.0);
  Eigen::Isometry3d all = Eigen::Isometry3d::Identity();
  for (int n = 0; n < kSectors; ++n, all = all * turn)
    for (const Strip& strip : sector.strips) {
      Strip& copy = path.strips.emplace_back(strip);
      for (Pose& pose : copy.poses) pose = {all * pose.tip, (all.linear() * pose.axis).normalized()};
    }
  path.strips.back().poses.back().tip.x() += wrong_mm;
  return path;
}

TEST(PathCopies, AreTheSectorsOfAWheel) {
  const PathCopies found = find_copies(wheel_path(0.0), kLength);
  EXPECT_EQ(found.strips, 3u);
  ASSERT_EQ(found.turns.size(), static_cast<std::size_t>(kSectors));
  EXPECT_EQ(found.turns.front().forth.matrix(), Eigen::Matrix4d::Identity());
}

TEST(PathCopies, AreNoneWhereAPoseIsElsewhere) {
  const PathCopies found = find_copies(wheel_path(1e-9), kLength);
  EXPECT_EQ(found.strips, 3u * kSectors);
  EXPECT_EQ(found.turns.size(), 1u);
}

TEST(PathCopies, AreNoneOfPosesThatAreNoNumbers) {
  Path path = wheel_path(0.0);
  path.strips[4].poses[1].tip.x() = std::nan("");
  EXPECT_EQ(find_copies(path, kLength).turns.size(), 1u);
  EXPECT_EQ(find_copies({}, kLength).turns.size(), 1u);
}

TEST(PathCopies, TheSearchFindsWhatItFindsInOneTree) {
  Tool tool;
  tool.radial = RadialFunction(ToolFamily::kCone, kLength, Eigen::Vector2d(1.0, 0.1));
  const SweptVolume copied(tool, wheel_path(0.0)), whole(tool, wheel_path(1e-9));
  Random random(8);
  int strips = 0;
  std::vector<Vec3> points;
  for (int i = 0; i < 400; ++i)
    points.push_back({random.uniform(-60, 60), random.uniform(-60, 60), random.uniform(-5, 25)});
  for (int i = 0; i < 400; ++i) points.push_back(points[300] + brute::random_vector(random, 0.5));  // together
  std::vector<SweptDistance> found(points.size());
  copied.distances(points, 50.0, found);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SweptDistance one = copied.distance(points[i], 50.0), other = whole.distance(points[i], 50.0);
    ASSERT_NEAR(one.f, other.f, 2e-9);
    ASSERT_NEAR(found[i].f, other.f, 2e-9);
    ASSERT_EQ(one.strip < 0, other.strip < 0);
    if (one.strip < 0) continue;
    strips = std::max(strips, one.strip);
    // Its place is one of the path's own.
    const SweptVolume::Ball ball = copied.ball(one), same = whole.ball(one);
    ASSERT_NEAR((points[i] - ball.center).norm() - ball.radius, one.f, 1e-9);
    ASSERT_LE((ball.center - same.center).norm(), 2e-9);
    const SweptVolume::BallWay way = copied.ball_way(one), whole_way = whole.ball_way(one);
    ASSERT_LE((way.from - whole_way.from).norm() + (way.along - whole_way.along).norm(), 4e-9);
    ASSERT_LE(copied.distance_from(points[i], one).f, one.f + 1e-9);
  }
  EXPECT_GT(strips, 3 * (kSectors - 1)) << "the last copy must have been met";
}

}  // namespace
}  // namespace flank::internal::verify
