// Passes along the sides take what is left there, climb milling, no more at once than is allowed.
#include "flank/wheel/rough/side_passes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace flank::internal {
namespace {

constexpr double kLength = 12.0, kHalf = 3.0, kTop = 4.0;
constexpr double kThin = 0.3;  // what the sides have left, for a tool of radius 1

/// Places across a channel that is cleared already but for `left` at both sides, where the flank comes to `kHalf` + 1.
struct Cleared {
  Cutter cutter{RadialFunction(ToolFamily::kCylinder, 6.0, Eigen::VectorXd::Ones(1))};
  ChannelLayer layer = [] {
    std::vector<ChannelLayer::Row> rows;
    for (double x = 0.0; x <= kLength; x += 0.5) {
      rows.emplace_back();
      for (int c = 0; c <= 16; ++c) rows.back().push_back({Vec3(x, kHalf * (c / 8.0 - 1.0), 0.0), Vec3::UnitZ()});
    }
    return ChannelLayer::stretches(rows, true, true, 2.0).front();
  }();
  StockGrid stock;
  explicit Cleared(double left)
      : stock(
            [] {
              Box3 box;
              box.add(Vec3(-4.0, -6.0, -1.0)), box.add(Vec3(kLength + 4.0, 6.0, 5.0));
              return box;
            }(),
            0.1,
            [left](const Vec3& p) {
              const double from = kHalf + 1.0 - left;
              return std::min({p.x(), kLength - p.x(), kTop - p.z(), std::abs(p.y()) - from});
            }) {}
  [[nodiscard]] std::vector<Strip> passes(const MotionTest& is_free = [](const Pose&, const Pose&) { return true; }) {
    return side_passes(layer, cutter, {.most_engagement_rad = std::numbers::pi / 3.0, .is_free = is_free}, "F1", stock);
  }
};

/// Of an arc: the tool of radius 1 is so deep in a straight side.
double degrees(double depth) { return std::acos(1.0 - depth) * 180.0 / std::numbers::pi; }

TEST(SidePasses, TakeWhatIsLeftAtBothSidesClimbMilling) {
  Cleared cleared(kThin);
  ASSERT_LT(degrees(kThin), 50.0);
  const std::vector<Strip> strips = cleared.passes();
  ASSERT_EQ(strips.size(), 2u);
  for (const Strip& strip : strips) {
    const Vec3 way = strip.poses.back().tip - strip.poses.front().tip;
    EXPECT_GE(way.norm(), kLength - 1.0);
    // The side is to the right of the way, seen from above.
    EXPECT_GT(way.cross(Vec3::UnitZ()).y() * strip.poses.front().tip.y(), 0.0);
    EXPECT_NEAR(std::abs(strip.poses.front().tip.y()), kHalf, 1e-9);
  }
  EXPECT_TRUE(cleared.passes().empty()) << "nothing is left there";
}

TEST(SidePasses, LeaveWhatWouldEngageTooMuch) {
  Cleared cleared(0.9);
  ASSERT_GT(degrees(0.9), 60.0);
  EXPECT_TRUE(cleared.passes().empty());
}

TEST(SidePasses, EndWhereTheToolMayNotGo) {
  Cleared cleared(kThin);
  const std::vector<Strip> strips =
      cleared.passes([](const Pose& a, const Pose& b) { return std::max(a.tip.x(), b.tip.x()) < 7.0; });
  ASSERT_EQ(strips.size(), 2u);
  for (const Strip& strip : strips)
    for (const Pose& pose : strip.poses) EXPECT_LT(pose.tip.x(), 7.0);
}

}  // namespace
}  // namespace flank::internal
