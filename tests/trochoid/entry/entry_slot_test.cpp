// The slot of an entry: where its moves go, and that none is steeper than it says.
#include "flank/trochoid/entry/entry_slot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace flank::internal {
namespace {

EntrySlot leaning_slot() {
  return {{Vec3(0.0, 0.0, 0.0), Vec3(0.1, -0.2, 1.0).normalized()},
          {Vec3(2.0, 16.0, 1.0), Vec3(0.0, 0.15, 1.0).normalized()},
          Vec3(1.5, 0.0, 0.0),
          30.0};
}

TEST(EntrySlot, AtFullDepthItGoesFromPoseToPoseAndBulges) {
  const EntrySlot slot = leaning_slot();
  const RuledMotion move = slot.move({0.0, 0.0}, {1.0, 0.0});
  EXPECT_LT((move.pose(0.0).tip - slot.from.tip).norm(), 1e-12);
  EXPECT_LT((move.pose(1.0).tip - slot.to.tip).norm(), 1e-12);
  EXPECT_LT((move.pose(1.0).axis - slot.to.axis).norm(), 1e-12);
  EXPECT_LT((move.pose(0.5).tip - (0.5 * (slot.from.tip + slot.to.tip) + slot.bulge)).norm(), 1e-12);
}

TEST(EntrySlot, AboveItTheToolIsDrawnBackAlongItsOwnAxis) {
  const EntrySlot slot = leaning_slot();
  for (const double along : {0.0, 0.2, 0.55, 1.0}) {
    const Pose low = slot.pose({along, 0.0}), high = slot.pose({along, 20.0});
    EXPECT_LT((high.axis - low.axis).norm(), 1e-12);
    EXPECT_LT((high.tip - low.tip).cross(low.axis).norm(), 1e-12);
    EXPECT_NEAR((high.tip - low.tip).norm(), 20.0, 0.5) << "the chord of two unit vectors is a little shorter";
  }
}

TEST(EntrySlot, AMoveGoesEvenlyInBothNumbers) {
  const EntrySlot slot = leaning_slot();
  const SlotPlace a{0.1, 9.0}, b{0.8, 5.0};
  const RuledMotion move = slot.move(a, b);
  for (const double t : {0.0, 0.3, 0.5, 0.9, 1.0}) {
    const Pose expected = slot.pose({std::lerp(a.along, b.along, t), std::lerp(a.height_mm, b.height_mm, t)});
    EXPECT_LT((move.pose(t).tip - expected.tip).norm(), 1e-12) << t;
    EXPECT_LT((move.pose(t).axis - expected.axis).norm(), 1e-12) << t;
  }
}

TEST(EntrySlot, TheLeastWayIsThatOfTheNarrowestHeight) {
  EntrySlot slot = leaning_slot();
  // Axes that come nearer to each other upwards are nearest at the top, others at the bottom.
  for (const bool inwards : {false, true}) {
    if (inwards) std::swap(slot.from.axis, slot.to.axis);
    double least = 1e300;
    for (double height = 0.0; height <= 20.0; height += 0.5)
      least = std::min(least, (slot.pose({1.0, height}).tip - slot.pose({0.0, height}).tip).norm());
    EXPECT_NEAR(slot.least_way(20.0), least, 1e-9);
  }
}

}  // namespace
}  // namespace flank::internal
