// Cycles of a straight slot: the limit holds between the planner's rows, nothing is left, and threads change nothing.
#include "flank/trochoid/cycles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "flank/threads.h"
#include "flank/verify/stock/replay.h"
#include "obstacle/obstacle_scene.h"
#include "sanitized.h"

namespace flank::internal {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0, kLength = 15.0, kRadius = 5.0, kSlot = 24.0;

SidePath straight(double y) {
  std::vector<Pose> poses;
  std::vector<double> t;
  for (int k = 0; k <= 20; ++k) {
    t.push_back(k / 20.0);
    poses.push_back({Vec3(kSlot * t.back(), y, 0.0), Vec3::UnitZ()});
  }
  return {fit_motion(poses, t, kLength, 6), false};
}

SweptStock slot() {
  return {RadialFunction(ToolFamily::kCylinder, kLength, Eigen::VectorXd::Constant(1, kRadius)),
          {{-Vec3::UnitX(), 0.0}, {Vec3::UnitX(), kSlot}, {Vec3::UnitZ(), kLength}}};
}

LayerCycles plan(SweptStock& stock, CycleStrategy strategy, double limit) {
  const LayerSides sides{straight(0.0), straight(10.0)};
  const HalfGuard guard({}, stock.radial());
  CycleOptions options;
  options.largest_rad = limit * kDegree;
  options.strategy = strategy;
  return plan_cycles(sides, guard, stock, options, {}, {});
}

TEST(Cycles, HoldTheLimitAtThreeTimesTheRows) {
  if (kSanitized) GTEST_SKIP() << "TheJudgesStockMeasuresWhatWasPlanned plans the same";
  SweptStock stock = slot();
  const LayerCycles out = plan(stock, CycleStrategy::kPlain, 60.0);
  ASSERT_EQ(out.status, CycleStatus::kDone);
  ASSERT_GT(out.cycles.size(), 5u);
  SweptStock again = slot();
  EngagementMeter meter(again);
  const std::vector<ToolRing> rings = tool_rings(again.radial(), 61, 0);
  double largest = 0.0;
  for (const Cycle& cycle : out.cycles) {
    if (cycle.back) {
      largest = std::max(largest, meter.measure(cycle.back->motion, rings, 301).peak.angle_rad);
      again.add(Sweep::of(cycle.back->motion, kHalfIntervals));
    }
    largest = std::max(largest, meter.measure(cycle.front.motion, rings, 301).peak.angle_rad);
    again.add(Sweep::of(cycle.front.motion, kHalfIntervals));
  }
  EXPECT_LE(largest, 60.0 * kDegree);
  EXPECT_GT(largest, 55.0 * kDegree) << "no less than there is room for";
}

TEST(Cycles, AdjustedFrontsHoldTheLimitWithLongerSteps) {
  if (kSanitized) GTEST_SKIP() << "TheJudgesStockMeasuresWhatWasPlanned has the cycles";
  SweptStock plain = slot(), adjusted = slot();
  const LayerCycles before = plan(plain, CycleStrategy::kPlain, 60.0);
  const LayerCycles after = plan(adjusted, CycleStrategy::kAdjusted, 60.0);
  ASSERT_EQ(after.status, CycleStatus::kDone);
  EXPECT_GT(after.cycles[2].from_x, before.cycles[2].from_x) << "the first steps are longer";
  for (const Cycle& cycle : after.cycles) EXPECT_LE(cycle.front.peak.angle_rad, 60.0 * kDegree);
}

constexpr double kStripPoses = 200.0;

/// Poses of a half, dense enough that joining them straight changes nothing that counts.
Strip strip_of(const RuledMotion& motion) {
  Strip strip;
  for (int k = 0; k <= static_cast<int>(kStripPoses); ++k) strip.poses.push_back(motion.pose(k / kStripPoses));
  return strip;
}

TEST(Cycles, TheJudgesStockMeasuresWhatWasPlanned) {
  if (kThreadSanitized) GTEST_SKIP() << "AreTheSameForOneAndTwoThreads has the threads";
  SweptStock stock = slot();
  const LayerCycles out = plan(stock, CycleStrategy::kPlain, 60.0);
  ASSERT_EQ(out.status, CycleStatus::kDone);
  std::vector<const Half*> halves;
  Path path;
  for (const Cycle& cycle : out.cycles)
    for (const Half* half : {cycle.back ? &*cycle.back : nullptr, &cycle.front}) {
      if (half == nullptr) continue;
      halves.push_back(half);
      path.strips.push_back(strip_of(half->motion));
    }
  // Deeper than the round end goes, and wider than the sides.
  Box3 box;
  box.add(Vec3(0.0, -6.0, -6.0));
  box.add(Vec3(kSlot, 16.0, kLength));
  verify::DexelStock judge(box, {}, 0.1);
  const verify::StockReplay replay = verify::replay(judge, stock.radial(), path, {.circles = 3});
  // The peak of a half may lie between its poses, so the replay may be below it, and not above.
  double largest = 0.0, planned_mm3 = 0.0, replayed_mm3 = 0.0;
  for (std::size_t k = 0; k < halves.size(); ++k) {
    EXPECT_LE(replay.strips[k].angle_rad, halves[k]->peak.angle_rad + 1.5 * kDegree) << "half " << k;
    largest = std::max(largest, halves[k]->peak.angle_rad);
    planned_mm3 += halves[k]->engagement.volume_mm3;
    replayed_mm3 += replay.strips[k].volume_mm3;
  }
  EXPECT_NEAR(planned_mm3 / replayed_mm3, 1.0, 0.002);
  EXPECT_NEAR(replay.largest() / kDegree, largest / kDegree, 1.5);
}

TEST(Cycles, LeaveNothingBetweenTheSidePaths) {
  if (kSanitized) GTEST_SKIP() << "TheJudgesStockMeasuresWhatWasPlanned plans the same";
  SweptStock stock = slot();
  ASSERT_EQ(plan(stock, CycleStrategy::kPlain, 60.0).status, CycleStatus::kDone);
  for (double x = 0.5; x < kSlot; x += 1.0)
    for (double y = 0.0; y <= 10.0; y += 1.0) EXPECT_FALSE(stock.is_material({x, y, 7.0})) << x << " " << y;
}

TEST(Cycles, EndBeforeAFaceThatEveryFrontEnters) {
  if (kThreadSanitized) GTEST_SKIP() << "AreTheSameForOneAndTwoThreads has the threads";
  // A post in the middle of the slot: no shape of a front gets round it, and through it is no way.
  Face post;
  post.id = "F1";
  post.surface.degree_u = post.surface.degree_v = 1;
  post.surface.knots_u = post.surface.knots_v = {0.0, 0.0, 1.0, 1.0};
  post.surface.count_u = post.surface.count_v = 2;
  post.surface.poles = {Vec3(10, 5, 0), Vec3(10, 5, kLength), Vec3(13, 5, 0), Vec3(13, 5, kLength)};
  const std::unique_ptr<Target> target = make_target({post});
  SweptStock stock = slot();
  const LayerSides sides{straight(0.0), straight(10.0)};
  const HalfGuard guard({{target.get()}, {}}, stock.radial());
  CycleOptions options;
  options.strategy = CycleStrategy::kPlain;
  const LayerCycles out = plan_cycles(sides, guard, stock, options, {}, {});
  EXPECT_EQ(out.status, CycleStatus::kStuck);
  EXPECT_GT(out.cycles.size(), 2u);
  EXPECT_LE(out.entered_mm(), 4.0 * options.tolerance_mm);
}

TEST(Cycles, RiseOverARidgeWithTheStepsOfALevelFloor) {
  if (kSanitized) GTEST_SKIP() << "EndBeforeAFaceThatEveryFrontEnters looks at faces, too";
  // A ridge 4 mm below the tips along the middle of the slot, but for its start: the tip's ball, 5 mm, goes 1 mm into it unless
  // it is lifted.
  const Face ridge = testing::quad(Vec3(8, 4.5, -4), Vec3(60, 4.5, -4), Vec3(8, 5.5, -4), Vec3(60, 5.5, -4), "F1");
  const Face side =
      testing::quad(Vec3(0, -5, 0), Vec3(kSlot, -5, 0), Vec3(0, -5, kLength), Vec3(kSlot, -5, kLength), "F2");
  const std::unique_ptr<Target> target = make_target({side});
  const ObstacleField field(testing::only({make_target({ridge}), false}), *target, 2.0, 0.0);
  const LayerSides sides{straight(0.0), straight(10.0)};
  CycleOptions options;
  const auto planned = [&](const GuardedFaces& faces) {
    SweptStock stock = slot();
    const HalfGuard guard(faces, stock.radial());
    return plan_cycles(sides, guard, stock, options, {}, {});
  };
  const LayerCycles level = planned({}), over = planned({{}, {&field}});
  ASSERT_EQ(over.status, CycleStatus::kDone);
  EXPECT_LE(over.entered_mm(), options.tolerance_mm);
  EXPECT_LE(over.cycles.size(), level.cycles.size() + 1);
}

TEST(Cycles, BeginBeforeAnEdgeThatASlenderToolMeetsBetweenTheRingsOfTheSearch) {
  if (kSanitized) GTEST_SKIP() << "HoldTheLimitAtThreeTimesTheRows has the first front";
  // The blank comes to an edge of 90 degrees, half way between two rings: where those just touch nothing, it is 1.5 radii deep.
  constexpr double kSlender = 30.0, kThin = 1.0, kEdge = 1.5;
  const Vec3 up = (Vec3::UnitZ() - Vec3::UnitX()).normalized(), down = (-Vec3::UnitZ() - Vec3::UnitX()).normalized();
  const auto side = [](double y) {
    std::vector<Pose> poses;
    std::vector<double> t;
    for (int k = 0; k <= 20; ++k) {
      t.push_back(k / 20.0);
      poses.push_back({Vec3(4.0 * t.back(), y, 0.0), Vec3::UnitZ()});
    }
    return SidePath(fit_motion(poses, t, kSlender, 6), false);
  };
  SweptStock stock(RadialFunction(ToolFamily::kCylinder, kSlender, Eigen::VectorXd::Constant(1, kThin)),
                   {{up, up.z() * kEdge}, {down, down.z() * kEdge}, {Vec3::UnitX(), 4.0}, {Vec3::UnitZ(), kSlender}});
  const LayerSides sides{side(0.0), side(4.0)};
  const HalfGuard guard({}, stock.radial());
  CycleOptions options;
  options.strategy = CycleStrategy::kPlain;
  const LayerCycles out = plan_cycles(sides, guard, stock, options, {}, {});
  EXPECT_EQ(out.status, CycleStatus::kDone);
  ASSERT_FALSE(out.cycles.empty());
  for (const Cycle& cycle : out.cycles) EXPECT_LE(cycle.front.peak.angle_rad, options.largest_rad);
}

TEST(CycleState, NoStepWithinTheLimitCountsAsRefused) {
  constexpr double kLimit = 60.0 * kDegree;
  CycleState now;
  now.refuse(0.3, 41.5 * kDegree, kLimit);
  EXPECT_EQ(now.refused.largest_rad, 0.0) << "who aims lower refuses it, but the limit does not";
  now.refuse(0.2, 63.0 * kDegree, kLimit);
  now.refuse(0.1, 61.0 * kDegree, kLimit);
  now.refuse(0.05, 62.0 * kDegree, kLimit);
  EXPECT_EQ(now.refused.step_mm, 0.1);
}

/// A search whose last front is in the middle of the slot.
struct Searching {
  SweptStock stock = slot();
  LayerSides sides{straight(0.0), straight(10.0)};
  HalfGuard guard;
  CycleOptions options;
  CycleSearch search;
  CycleState now;
  explicit Searching(const GuardedFaces& faces)
      : guard(faces, stock.radial()), search(sides, guard, stock, options), now(search.anew({})) {
    constexpr double kStep = 1.0, kMiddle = 8.0;
    now.last.from_x = now.last.to_x = -12.0;
    while (now.last.from_x < kMiddle) {
      Trial next = search.plan(now, now.shape, kStep);
      next.back.reset();
      stock.add(Sweep::of(next.front, kHalfIntervals));
      now.last = std::move(next);
    }
  }
};

TEST(CycleSearch, ACycleIsLiftedAsItNeedsWhateverTheOneBeforeWas) {
  // A ridge of 4 mm below the tips, along the middle: half of the lift of the cycle before, or one and a half times as much as it takes,
  // made every other step a short one.
  const Face ridge = testing::quad(Vec3(-60, 4.5, -4), Vec3(60, 4.5, -4), Vec3(-60, 5.5, -4), Vec3(60, 5.5, -4), "F1");
  const Face side =
      testing::quad(Vec3(0, -5, 0), Vec3(kSlot, -5, 0), Vec3(0, -5, kLength), Vec3(kSlot, -5, kLength), "F2");
  const std::unique_ptr<Target> target = make_target({side});
  const ObstacleField field(testing::only({make_target({ridge}), false}), *target, 2.0, 0.0);
  double usual = 0.0;
  for (const double before : {0.0, 0.9, 1.4, 2.5}) {
    Searching setup({{}, {&field}});
    setup.now.shape.lift_mm = before;
    FoundCycle best = setup.search.best(setup.now, false);
    ASSERT_TRUE(best.some());
    EXPECT_FALSE(setup.search.enters_anything(best.trial));
    const double lift = best.now.shape.lift_mm;
    EXPECT_GT(lift, 0.5);
    if (before == 0.0) usual = lift;
    EXPECT_NEAR(lift, usual, 0.1 * usual) << before;
  }
}

TEST(CycleSearch, ACycleIsLiftedBetweenEndsThatEnterTheFloorThemselves) {
  // The ends are 0.015 mm deep in the floor, and stay so; in the middle it is a hundredth of a millimetre higher.
  const auto level = [](double low_y, double high_y, double z, const char* name) {
    return testing::quad(Vec3(-60, low_y, z), Vec3(60, low_y, z), Vec3(-60, high_y, z), Vec3(60, high_y, z), name);
  };
  const Face floor = level(-30, 40, -4.985, "F1"), ridge = level(3, 7, -4.975, "F3");
  const Face side =
      testing::quad(Vec3(0, -5, 0), Vec3(kSlot, -5, 0), Vec3(0, -5, kLength), Vec3(kSlot, -5, kLength), "F2");
  const std::unique_ptr<Target> target = make_target({side});
  const ObstacleField low(testing::only({make_target({floor}), false}), *target, 2.0, 0.0),
      high(testing::only({make_target({ridge}), false}), *target, 2.0, 0.0);
  Searching setup({{}, {&low, &high}});
  FoundCycle best = setup.search.best(setup.now, false);
  ASSERT_TRUE(best.some());
  EXPECT_FALSE(setup.search.enters_anything(best.trial));
  EXPECT_GT(best.now.shape.lift_mm, 0.0);
}

TEST(CycleSearch, ABackThatEngagesTooFarIsNotKept) {
  Searching setup({});
  // It goes forward into full material before it comes back to the first side: no front is to blame.
  setup.now.shape.back = {0.4, 0.02, 0.8};
  const FoundCycle best = setup.search.best(setup.now, false);
  ASSERT_TRUE(best.some());
  EXPECT_LE(best.trial.largest_rad, setup.options.largest_rad);
  EXPECT_GT(best.step(), setup.search.least_step());
}

TEST(CycleSearch, GivesTheSameForTheSameState) {
  // Whatever was looked for in between: nothing but the state is remembered that a result depends on.
  Searching setup({});
  const auto front = [&](const CycleState& now) { return setup.search.best(now, true).trial.front.tip.poles; };
  const auto first = front(setup.now);
  CycleState other = setup.now;
  other.shape.front = {0.3, 0.05, 0.2};
  EXPECT_NE(front(other), first);
  EXPECT_EQ(front(setup.now), first);
}

TEST(Cycles, GoOnPastTheSidesWhereTheWallIsFartherOn) {
  if (kSanitized) GTEST_SKIP() << "TheJudgesStockMeasuresWhatWasPlanned has the cycles";
  SweptStock stock = slot();
  LayerSides sides{straight(0.0), straight(10.0)};
  for (SidePath* path : {&sides.from, &sides.to}) path->stop_at(true, 1.5 * kRadius);
  const HalfGuard guard({}, stock.radial());
  CycleOptions options;
  options.strategy = CycleStrategy::kPlain;
  const LayerCycles out = plan_cycles(sides, guard, stock, options, {}, {});
  EXPECT_EQ(out.status, CycleStatus::kDone);
  EXPECT_EQ(out.before_wall_mm, 0.0) << "nothing of the sides is left before it";
  EXPECT_GE(out.cycles.back().from_x, sides.from.length());
  EXPECT_GE(out.cycles.back().to_x, sides.to.length());
}

TEST(Cycles, AreTheSameForOneAndTwoThreads) {
  const auto poles = [](int threads) {
    set_thread_count(threads);
    SweptStock stock = slot();
    const LayerCycles out = plan(stock, CycleStrategy::kVolume, 80.0);
    set_thread_count(0);
    return out.cycles.back().front.motion.tip.poles;
  };
  EXPECT_EQ(poles(1), poles(2));
}

}  // namespace
}  // namespace flank::internal
