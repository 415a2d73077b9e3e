// Entries of a slot with walls at both ends: they open the first front from above, enter nothing, and cycles go on from there.
#include "flank/trochoid/entry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "flank/verify/stock/replay.h"
#include "obstacle/obstacle_scene.h"
#include "sanitized.h"

namespace flank::internal {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0, kLength = 15.0, kRadius = 5.0, kSlot = 24.0, kGap = 10.0;
/// Of the end walls beyond the tool at both ends of the sides.
constexpr double kRoom = 1e-3;
const ClearPlane kClear{Vec3::UnitZ(), kLength + 2.0 * kRadius};

SidePath side(double y) {
  std::vector<Pose> poses;
  std::vector<double> t;
  for (int k = 0; k <= 20; ++k) {
    t.push_back(k / 20.0);
    poses.push_back({Vec3(kSlot * t.back(), y, 0.0), Vec3::UnitZ()});
  }
  SidePath path(fit_motion(poses, t, kLength, 6), false);
  path.stop_at(false);
  path.stop_at(true);
  return path;
}

std::unique_ptr<Target> end_wall(double x, double sign) {
  return make_target({testing::quad(Vec3(x, -50.0 * sign, -50), Vec3(x, 50.0 * sign, -50), Vec3(x, -50.0 * sign, 50),
                                    Vec3(x, 50.0 * sign, 50), "F3")});
}

class EntryTest : public ::testing::Test {
 protected:
  RadialFunction radial_{ToolFamily::kCylinder, kLength, Eigen::VectorXd::Constant(1, kRadius)};
  SweptStock stock_{
      radial_, {{-Vec3::UnitX(), kRadius + kRoom}, {Vec3::UnitX(), kSlot + kRadius + kRoom}, {Vec3::UnitZ(), kLength}}};
  std::unique_ptr<Target> start_ = end_wall(-kRadius - kRoom, 1.0), end_ = end_wall(kSlot + kRadius + kRoom, -1.0);
  HalfGuard guard_{{{start_.get(), end_.get()}, {}}, radial_};
  LayerSides sides_{side(0.0), side(kGap)};

  std::optional<Entry> plan(EntryMethod method, double slope_deg = 3.0) {
    return plan_entry(sides_, guard_, stock_, kClear, {method, slope_deg * kDegree}, {}, {});
  }
  /// Deepest that the moves enter a wall.
  [[nodiscard]] double entered(const Entry& entry) const {
    double deepest = 0.0;
    for (const RuledMotion& move : entry.moves) deepest = std::max(deepest, guard_.depth(move, 25, 9).deepest());
    return deepest;
  }
};

TEST_F(EntryTest, ARampSinksNoSteeperThanItsSlope) {
  const std::optional<Entry> entry = plan(EntryMethod::kRamp, 4.0);
  ASSERT_TRUE(entry);
  EXPECT_GE(entry->moves.front().pose(0.0).tip.z(), kLength) << "it begins above the blank";
  for (std::size_t k = 0; k < entry->moves.size(); ++k) {
    const Pose from = entry->moves[k].pose(0.0), to = entry->moves[k].pose(1.0);
    const double way = (to.tip - from.tip).head<2>().norm();
    EXPECT_LE(from.tip.z() - to.tip.z(), std::tan(4.0 * kDegree) * way + 1e-9);
    EXPECT_NEAR(way, kGap, 1e-9) << "to and fro from side to side";
    if (k == 0) continue;
    EXPECT_LT((entry->moves[k - 1].pose(1.0).tip - from.tip).norm(), 1e-9);
  }
  EXPECT_LE(entry->slope_rad, 4.0 * kDegree);
  EXPECT_LE(entered(*entry), 0.01);
  EXPECT_LT((entry->moves.back().pose(1.0).tip - entry->front.motion.pose(1.0).tip).norm(), 1e-9);
  EXPECT_NEAR(entry->largest_rad, std::numbers::pi, 1e-6) << "a slot";
}

TEST_F(EntryTest, PlungesGoDownTheAxisSideBySide) {
  const std::optional<Entry> entry = plan(EntryMethod::kPlunge);
  ASSERT_TRUE(entry);
  int plunges = 0;
  for (const RuledMotion& move : entry->moves) {
    const Vec3 by = move.pose(1.0).tip - move.pose(0.0).tip;
    if (by.z() < -1e-9) {
      ++plunges;
      EXPECT_LT(by.head<2>().norm(), 1e-9);
    } else if (by.z() < 1e-9 && move.pose(0.0).tip.z() > 1.0) {
      EXPECT_LE(by.norm(), 0.5 * kRadius + 1e-9);
    }
  }
  EXPECT_EQ(plunges, 5);
  EXPECT_LE(entered(*entry), 0.01);
}

TEST_F(EntryTest, TheJudgesStockRemovesAsMuch) {
  const std::optional<Entry> entry = plan(EntryMethod::kRamp);
  ASSERT_TRUE(entry);
  Path path;
  for (const RuledMotion& move : entry->moves) {
    Strip strip;
    for (int k = 0; k <= 40; ++k) strip.poses.push_back(move.pose(k / 40.0));
    path.strips.push_back(std::move(strip));
  }
  Box3 box;
  box.add(Vec3(-kRadius - 1.0, -6.0, -6.0));
  box.add(Vec3(kSlot, 16.0, kLength));
  verify::DexelStock judge(box, stock_.blank(), 0.2);
  const verify::StockReplay replay = verify::replay(judge, radial_, path, {.circles = 0});
  EXPECT_NEAR(entry->volume_mm3 / (replay.before_mm3 - replay.after_mm3), 1.0, 0.01);
}

TEST_F(EntryTest, CyclesGoOnFromItToTheOtherWallWithinTheLimit) {
  if (kThreadSanitized) GTEST_SKIP() << "Cycles.AreTheSameForOneAndTwoThreads has the threads";
  const std::optional<Entry> entry = plan(EntryMethod::kRamp);
  ASSERT_TRUE(entry);
  CycleOptions options;
  options.largest_rad = 90.0 * kDegree;  // fewer cycles
  const LayerCycles out = plan_cycles(sides_, guard_, stock_, options, entry->front, {});
  ASSERT_EQ(out.status, CycleStatus::kDone);
  EXPECT_LE(out.entered_mm(), 0.01);
  for (const Cycle& cycle : out.cycles) {
    EXPECT_LE(cycle.front.peak.angle_rad, options.largest_rad);
    if (!cycle.back) continue;
    EXPECT_LE(cycle.back->peak.angle_rad, options.largest_rad);
  }

  EXPECT_LE(out.before_wall_mm, 0.5 * kRadius) << "a corner engages the tool from wall to wall";
  for (double x = -4.9; x < kSlot + kRadius - out.before_wall_mm - 0.5; x += 0.7)
    for (double y = 0.0; y <= kGap; y += 1.0) EXPECT_FALSE(stock_.is_material({x, y, 7.0})) << x << " " << y;
}

TEST_F(EntryTest, AWallThatStandsInTheWayMovesTheFirstFrontOn) {
  // A post before the start wall, between the sides.
  const auto post =
      make_target({testing::quad(Vec3(-1, 5, -50), Vec3(-1, 5, 50), Vec3(-1.5, 5, -50), Vec3(-1.5, 5, 50), "F4")});
  const HalfGuard guard({{start_.get(), end_.get(), post.get()}, {}}, radial_);
  const std::optional<Entry> entry =
      plan_entry(sides_, guard, stock_, kClear, {EntryMethod::kRamp, 3.0 * kDegree}, {}, {});
  ASSERT_TRUE(entry);
  EXPECT_LE(guard.depth(entry->front.motion, 25, 9).deepest(), 0.01);
  EXPECT_GT(entry->front.from_x + entry->front.motion.pose(0.5).tip.x(), 3.0);
}

TEST_F(EntryTest, NoWayInIsSaid) {
  // A roof over the whole cavity.
  const auto roof =
      make_target({testing::quad(Vec3(-50, -50, 22), Vec3(-50, 50, 22), Vec3(80, -50, 22), Vec3(80, 50, 22), "F4")});
  const HalfGuard guard({{start_.get(), end_.get(), roof.get()}, {}}, radial_);
  EXPECT_FALSE(plan_entry(sides_, guard, stock_, kClear, {EntryMethod::kRamp, 3.0 * kDegree}, {}, {}));
  EXPECT_TRUE(stock_.sweeps().empty());
}

TEST_F(EntryTest, ASearchThatIsStoppedLooksForNoFurtherPlace) {
  const auto roof =
      make_target({testing::quad(Vec3(-50, -50, 22), Vec3(-50, 50, 22), Vec3(80, -50, 22), Vec3(80, 50, 22), "F4")});
  const HalfGuard guard({{start_.get(), end_.get(), roof.get()}, {}}, radial_);
  int asked = 0;
  Progress progress;
  progress.cancelled = [&] { return ++asked > 2; };
  EXPECT_FALSE(plan_entry(sides_, guard, stock_, kClear, {EntryMethod::kRamp, 3.0 * kDegree}, {}, progress));
  EXPECT_EQ(asked, 3) << "once for each place of the first front";
}

}  // namespace
}  // namespace flank::internal
