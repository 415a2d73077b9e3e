// The blank's planes hold both sides, and lie as near as skewed and leaning edges let them.
#include "flank/trochoid/blank.h"

#include <gtest/gtest.h>

#include "obstacle/obstacle_scene.h"

namespace flank::internal {
namespace {

using testing::quad;

constexpr double kAcross = 20.0, kSkew = 14.0, kLean = 0.3, kHeight = 30.0, kLong = 50.0;

/// A wall in the plane of a y: from x = skew, both edges leaning forward.
std::unique_ptr<Target> wall(double y, double skew) {
  const double top = kLean * kHeight;
  return make_target(
      {quad({skew, y, 0.0}, {skew + kLong, y, 0.0}, {skew + top, y, kHeight}, {skew + kLong + top, y, kHeight}, "F1")});
}

SidePath side(double y, double skew) {
  std::vector<Pose> poses;
  std::vector<double> t;
  for (int k = 0; k <= 20; ++k) {
    t.push_back(k / 20.0);
    poses.push_back({Vec3(skew + kLong * t.back(), y, 0.0), Vec3(kLean, 0.0, 1.0).normalized()});
  }
  return {fit_motion(poses, t, kHeight, 6), false};
}

TEST(CavityBlank, LeavesNoWedgeBeforeSkewedEdges) {
  const std::unique_ptr<Target> left = wall(0.0, 0.0), right = wall(kAcross, kSkew);
  const std::vector<HalfSpace> blank = cavity_blank({{side(3.0, 0.0), side(kAcross - 3.0, kSkew)}}, *left, *right);
  ASSERT_EQ(blank.size(), 3u);
  for (const HalfSpace& half : blank)
    for (const Target* target : {left.get(), right.get()})
      for (const Vec3& p : target->border_points(1.0)) EXPECT_LE(half.normal.dot(p), half.offset + 1e-9);
  // Both ends are planes through two edges that are parallel: they meet them all along.
  const Vec3 across(kSkew, kAcross, 0.0), leaning(kLean, 0.0, 1.0);
  const Vec3 normal = leaning.cross(across).normalized();
  for (std::size_t end = 0; end < 2; ++end) {
    EXPECT_NEAR(std::abs(blank[end].normal.dot(normal)), 1.0, 1e-5) << end;
    EXPECT_NEAR(blank[end].offset, blank[end].normal.dot(Vec3(end == 0 ? 0.0 : kLong, 0.0, 0.0)), 1e-2) << end;
  }
  EXPECT_NEAR(blank[2].normal.z(), 1.0, 1e-6);
  EXPECT_NEAR(blank[2].offset, kHeight, 1e-3);
}

}  // namespace
}  // namespace flank::internal
