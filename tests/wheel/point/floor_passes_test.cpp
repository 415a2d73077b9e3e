// Passes on a floor between two walls leave scallops within their share and cut neither floor nor walls.
#include "flank/wheel/point/floor_passes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "flank/judge.h"

namespace flank::internal {
namespace {

constexpr double kLength = 40.0, kWidth = 12.0, kHeight = 20.0, kTip = 2.0, kAxis = 18.0;

/// A bilinear face whose normal is du x dv.
Face plane(const Vec3& corner, const Vec3& along_u, const Vec3& along_v) {
  Face face;
  BSplineSurface& s = face.surface;
  s.degree_u = s.degree_v = 1;
  s.count_u = s.count_v = 2;
  s.knots_u = s.knots_v = {0.0, 0.0, 1.0, 1.0};
  s.poles = {corner, corner + along_v, corner + along_u, corner + along_u + along_v};
  return face;
}

struct Channel {
  std::unique_ptr<Target> floor = make_target({plane(Vec3::Zero(), kLength* Vec3::UnitX(), kWidth* Vec3::UnitY())});
  std::unique_ptr<Target> near = make_target({plane(Vec3::Zero(), kHeight* Vec3::UnitZ(), kLength* Vec3::UnitX())});
  std::unique_ptr<Target> far =
      make_target({plane(Vec3(0.0, kWidth, 0.0), kLength* Vec3::UnitX(), kHeight* Vec3::UnitZ())});
  RadialFunction radial{ToolFamily::kCylinder, kAxis, Eigen::VectorXd::Constant(1, kTip)};

  /// Along a wall, upright; `lift`: how high the tip is over its place on the floor.
  [[nodiscard]] static std::vector<Pose> along(double y, double lift, bool back) {
    std::vector<Pose> out;
    for (int k = 0; k <= 40; ++k) out.push_back({Vec3(k, y, kTip + lift), Vec3::UnitZ()});
    if (back) std::reverse(out.begin(), out.end());
    return out;
  }
  [[nodiscard]] FloorChannel asked(double first_y) const {
    return {{floor.get()}, {near.get(), far.get()}, along(first_y, 3.0, false), along(kWidth - kTip, 1.0, true)};
  }
  [[nodiscard]] Path passes(double first_y) const {
    Path path;
    path.strips = floor_passes(asked(first_y), radial, {.tolerance_mm = 0.05}, "F1");
    return path;
  }
};

TEST(FloorPasses, LeaveScallopsWithinTheirShareAndCutNothing) {
  const Channel channel;
  const Path path = channel.passes(kTip);
  ASSERT_GT(path.strips.size(), 5U);
  Tool tool;
  tool.radial = channel.radial;
  const SweptVolume volume(tool, path);
  double lowest = 1e300, highest = -1e300;
  for (double x = 2.0; x < kLength - 2.0; x += 0.37)
    for (double y = kTip; y <= kWidth - kTip; y += 0.11) {
      const double f = volume.distance(Vec3(x, y, 0.0)).f;
      lowest = std::min(lowest, f), highest = std::max(highest, f);
    }
  EXPECT_GE(lowest, -1e-6);
  EXPECT_LE(highest, 0.05);
  EXPECT_GT(highest, 0.01) << "passes that are closer than the tolerance asks for take time for nothing";
  for (const Strip& strip : path.strips) {
    EXPECT_EQ(strip.kind, "floor");
    for (const Pose& pose : strip.poses) {
      EXPECT_GE(pose.tip.y(), kTip - 1e-3);
      EXPECT_LE(pose.tip.y(), kWidth - kTip + 1e-3);
    }
  }
}

TEST(FloorPasses, ASidePathThatIsInsideTheWallIsLeftForTheMiddle) {
  const Channel channel;
  const Path path = channel.passes(0.5 * kTip);
  ASSERT_FALSE(path.strips.empty());
  double least = 1e300;
  for (const Strip& strip : path.strips)
    for (const Pose& pose : strip.poses) least = std::min(least, pose.tip.y());
  EXPECT_NEAR(least, kTip, 0.01);
}

TEST(FloorPasses, PathsThatDoNotRunBesideEachOtherHaveNone) {
  const Channel channel;
  FloorChannel asked = channel.asked(kTip);
  for (Pose& pose : asked.second) pose.tip.x() += 3.0 * kLength;
  EXPECT_TRUE(floor_passes(asked, channel.radial, {}, "F1").empty());
}

}  // namespace
}  // namespace flank::internal
