// What comes nearer to a disc than its reach is always found, in its order, and little else.
#include "flank/trochoid/engagement/pose_filter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace flank::internal {
namespace {

std::vector<NearPose> random_poses(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-40.0, 40.0), tilt(-0.3, 0.3);
  std::vector<NearPose> out(count);
  for (NearPose& pose : out) pose = {.x0 = place(random), .y0 = place(random), .dx = tilt(random), .dy = tilt(random)};
  return out;
}

/// How much nearer to one of the discs than its reach, mm.
double nearer(const NearPose& pose, double z, const std::vector<ReachDisc>& discs) {
  double most = -1e300;
  for (const ReachDisc& disc : discs)
    most = std::max(most, disc.reach - std::hypot(pose.x0 + z * pose.dx - disc.x, pose.y0 + z * pose.dy - disc.y));
  return most;
}

const std::vector<ReachDisc> kDiscs = {{3.0, -4.0, 7.0}, {-12.5, 20.0, 2.5}};

TEST(PoseFilter, LeavesNothingOutAndAddsLittle) {
  constexpr double kMostAddedMm = 0.01;
  const std::vector<NearPose> poses = random_poses(5003, 1);
  PoseFilter filter;
  filter.take(poses, true);
  for (const double z : {-5.0, 0.0, 17.25, 60.0}) {
    const std::vector<std::size_t> found = filter.reaching(z, kDiscs);
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
    EXPECT_GT(found.size(), 20u);
    std::size_t next = 0;
    for (std::size_t k = 0; k < poses.size(); ++k) {
      const bool in = next < found.size() && found[next] == k;
      if (in) ++next;
      const double depth = nearer(poses[k], z, kDiscs);
      EXPECT_TRUE(in || depth <= 0.0) << k << " is " << depth << " mm within reach";
      EXPECT_TRUE(!in || depth > -kMostAddedMm) << k;
    }
  }
}

TEST(PoseFilter, TakesASecondLookAfterTheFirst) {
  const std::vector<NearPose> poses = random_poses(300, 2);
  PoseFilter whole, parts;
  whole.take(poses, true);
  parts.take(random_poses(40, 3), true);
  parts.take(std::span(poses).first(100), true);  // of another row: nothing of it stays
  parts.take(poses, false);
  EXPECT_EQ(parts.reaching(4.0, kDiscs), whole.reaching(4.0, kDiscs));
}

TEST(PoseFilter, WithoutDiscsNothingReaches) {
  PoseFilter filter;
  filter.take(random_poses(10, 4), true);
  EXPECT_TRUE(filter.reaching(0.0, {}).empty());
}

}  // namespace
}  // namespace flank::internal
