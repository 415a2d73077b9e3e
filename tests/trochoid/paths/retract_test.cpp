// Ways out of a cavity: along the axis where that is free, else another that enters nothing.
#include "flank/trochoid/paths/retract.h"

#include <gtest/gtest.h>

#include "obstacle/obstacle_scene.h"

namespace flank::internal {
namespace {

using testing::standing_blade;

constexpr double kRadius = 3.0, kLength = 30.0, kAllowed = 0.01;
const RadialFunction kTool(ToolFamily::kCylinder, kLength, Eigen::VectorXd::Constant(1, kRadius));
const ClearPlane kClear{Vec3::UnitZ(), 60.0};

class RetractTest : public ::testing::Test {
 protected:
  std::unique_ptr<Target> blade_ = standing_blade(0.0);  ///< y = 0
  HalfGuard guard_{{{blade_.get()}, {}}, kTool};

  /// Deepest between the poses, looked at in small steps.
  [[nodiscard]] double deepest(const std::vector<Pose>& way) const {
    GuardDepth depth;
    for (std::size_t k = 1; k < way.size(); ++k)
      for (int i = 0; i <= 200; ++i)
        guard_.look({way[k - 1].tip + i / 200.0 * (way[k].tip - way[k - 1].tip), way[k].axis}, 61, depth);
    return depth.deepest();
  }
};

TEST_F(RetractTest, AlongTheAxisWhereThatIsFree) {
  const Pose from{Vec3(20.0, kRadius + 0.1, 4.0), Vec3(0.2, 0.1, 1.0).normalized()};
  const std::vector<Pose> way = retract(from, {Vec3::UnitX()}, kClear, kTool, guard_, kAllowed);
  ASSERT_EQ(way.size(), 2u);
  EXPECT_LT((way[1].tip - way[0].tip).normalized().cross(from.axis).norm(), 1e-12);
  EXPECT_NEAR(way[1].tip.z(), kClear.height, 1e-9);
  EXPECT_LE(deepest(way), kAllowed);
}

TEST_F(RetractTest, AnotherWayWhereTheAxisLeadsIntoAWall) {
  // Beside the blade and leaning over it: straight up the upper end stays where it is.
  const Pose beside{Vec3(20.0, 0.5 * kLength + kRadius + 1.0, 4.0), Vec3(0.0, -0.5, 1.0).normalized()};
  std::vector<Pose> along{beside, {beside.at(62.0), beside.axis}};
  ASSERT_GT(deepest(along), 1.0);
  const std::vector<Pose> up = retract(beside, {}, kClear, kTool, guard_, kAllowed);
  EXPECT_LE(deepest(up), kAllowed);
  EXPECT_GE(up.back().tip.z(), kClear.height - 1e-9);
}

TEST_F(RetractTest, OutwardFirstWhereAllOtherWaysEnter) {
  // Behind the end of the blade, under a roof that goes on a little farther, leaning back.
  const auto roof =
      make_target({testing::quad(Vec3(0, 20, 45), Vec3(66, 20, 45), Vec3(0, -20, 45), Vec3(66, -20, 45), "F2")});
  guard_ = HalfGuard({{blade_.get(), roof.get()}, {}}, kTool);
  const Pose behind{Vec3(68.0, 0.0, 4.0), Vec3(-0.12, 0.0, 1.0).normalized()};
  const std::vector<Pose> way = retract(behind, {Vec3(2.0, 0.0, 0.0)}, kClear, kTool, guard_, kAllowed);
  const std::vector<Pose> closed = retract(behind, {}, kClear, kTool, guard_, kAllowed);
  ASSERT_EQ(way.size(), 3u);
  EXPECT_LE(deepest(way), kAllowed);
  EXPECT_GE(way.back().tip.z(), kClear.height - 1e-9);
  EXPECT_EQ(closed.size(), 2u);
  EXPECT_GT(deepest(closed), 0.5);
}

TEST_F(RetractTest, AsideFirstWhereASideLeansOverTheTool) {
  // A shelf over the place beside the blade: only off the side there is a way up.
  const auto shelf =
      make_target({testing::quad(Vec3(0, -5, 45), Vec3(0, 7, 45), Vec3(60, -5, 45), Vec3(60, 7, 45), "F2")});
  guard_ = HalfGuard({{blade_.get(), shelf.get()}, {}}, kTool);
  const Pose beside{Vec3(20.0, kRadius + 0.1, 4.0), Vec3::UnitZ()};
  const std::vector<Pose> closed = retract(beside, {}, kClear, kTool, guard_, kAllowed);
  EXPECT_GT(deepest(closed), 0.5);
  const std::vector<Pose> way = retract(beside, {Vec3::Zero(), Vec3(0.0, 8.0, 0.0)}, kClear, kTool, guard_, kAllowed);
  EXPECT_LE(deepest(way), kAllowed);
  EXPECT_GE(way.back().tip.z(), kClear.height - 1e-9);
}

TEST_F(RetractTest, ALinkIsDrawnUpOffAFloorThatRisesOnItsWay) {
  // A floor that is 0.3 mm above the tip of the ball in the middle of the way, and falls to both of its ends.
  const auto slope = [](double x, double end, const char* name) {
    const Vec3 low(std::min(x, end), 0, 0), high(std::max(x, end), 0, 0);
    const auto at = [&](const Vec3& p, double y) { return Vec3(p.x(), y, p.x() == 0.0 ? 0.3 : -1.0); };
    return make_target({testing::quad(at(low, -50), at(high, -50), at(low, 50), at(high, 50), name)});
  };
  const auto before = slope(-40.0, 0.0, "F2"), behind = slope(0.0, 40.0, "F3");
  guard_ = HalfGuard({{before.get(), behind.get()}, {}}, kTool);
  std::vector<Pose> way;
  for (double x = -30.0; x <= 30.0; x += 1.0) way.push_back({Vec3(x, 20.0, kRadius), Vec3::UnitZ()});
  ASSERT_GT(deepest(way), 0.25);
  const std::vector<Pose> link = off_floor(way, kTool, guard_, kAllowed);
  EXPECT_LE(deepest(link), kAllowed);
  ASSERT_EQ(link.size(), way.size() + 2);
  EXPECT_EQ(link.front().tip, way.front().tip);
  EXPECT_EQ(link.back().tip, way.back().tip);
  EXPECT_LT(link[30].tip.z(), kRadius + 1.0) << "no higher than it takes";
}

TEST_F(RetractTest, ALinkThatEntersNothingStaysWhereItIs) {
  const std::vector<Pose> way{{Vec3(10.0, 5.0, 4.0), Vec3::UnitZ()}, {Vec3(40.0, 6.0, 4.0), Vec3::UnitZ()}};
  EXPECT_EQ(off_floor(way, kTool, guard_, kAllowed).size(), way.size());
}

TEST_F(RetractTest, WhatIsAboveStaysWhereItIs) {
  const Pose above{Vec3(0.0, 20.0, 61.0), Vec3::UnitZ()};
  EXPECT_EQ(retract(above, {Vec3::UnitX()}, kClear, kTool, guard_, kAllowed).size(), 1u);
}

}  // namespace
}  // namespace flank::internal
