// How finely the faces around a target are cut for the ball that says what is reachable.
#include "flank/setup/target_reach.h"

#include <gtest/gtest.h>

#include "verify/faces.h"

namespace flank::internal {
namespace {

TEST(ReachFineness, IsAQuarterOfTheToleranceForPartsOfAHandsSize) {
  const ReachFineness fine = reach_fineness(0.02, 3.0);
  EXPECT_DOUBLE_EQ(fine.fine_mm, 0.005);
  EXPECT_DOUBLE_EQ(fine.cell_mm, 1.0);
  EXPECT_DOUBLE_EQ(reach_fineness(1e-5, 3.0).fine_mm, 0.001);
  EXPECT_DOUBLE_EQ(reach_fineness(0.5, 3.0).fine_mm, 0.01);
}

TEST(ReachFineness, ShrinksWithTheBallOfAPartOfAMillimetre) {
  // A thousandth of a millimetre is all of the tolerance there, and a cell of one millimetre all of the part.
  const ReachFineness tiny = reach_fineness(0.001, 0.04);
  EXPECT_DOUBLE_EQ(tiny.fine_mm, 0.00025);
  EXPECT_DOUBLE_EQ(tiny.cell_mm, 0.04);
  EXPECT_DOUBLE_EQ(reach_fineness(1e-6, 0.04).fine_mm, 4e-5);
  // But not on a hub of a metre beside it.
  EXPECT_DOUBLE_EQ(tiny.cell_on(1.0), 0.04);
  EXPECT_DOUBLE_EQ(tiny.cell_on(1000.0), 1.0);
  EXPECT_DOUBLE_EQ(reach_fineness(1e-6, 0.04).fine_on(1000.0), 0.001);
  EXPECT_DOUBLE_EQ(reach_fineness(0.02, 3.0).cell_on(100.0), 1.0);
}

TEST(ReachFineness, GrowsWithTheBallSoThatAShipTakesNoMoreTrianglesThanABlade) {
  const ReachFineness blade = reach_fineness(0.3, 10.0), ship = reach_fineness(300.0, 10000.0);
  EXPECT_NEAR(ship.fine_mm, 1000.0 * blade.fine_mm, 1e-9);
  EXPECT_NEAR(ship.coarse_mm, 1000.0 * blade.coarse_mm, 1e-9);
  EXPECT_NEAR(ship.cell_mm, 1000.0 * blade.cell_mm, 1e-9);
  // Where more is asked for, it is as fine as that.
  EXPECT_DOUBLE_EQ(reach_fineness(0.02, 10000.0).fine_mm, 0.005);
}

/// Four walls and a lid over [10, 20] x [10, 30] of the plane y = 0, on its side -y; open where it stands.
TriangleMesh box_without_floor() {
  TriangleMesh box;
  for (const double y : {0.0, -8.0})
    for (const Vec2& p : {Vec2(10.0, 10.0), Vec2(20.0, 10.0), Vec2(20.0, 30.0), Vec2(10.0, 30.0)})
      box.vertices.emplace_back(p.x(), y, p.y());
  for (int k = 0; k < 4; ++k) {
    const int next = (k + 1) % 4;
    box.triangles.push_back({k, next, next + 4}), box.triangles.push_back({k, next + 4, k + 4});
  }
  box.triangles.push_back({4, 5, 6}), box.triangles.push_back({4, 6, 7});
  return box;
}

TEST(TargetReach, WhatABodyThatStandsThereCoversIsNotAccessible) {
  flank::internal::Setup setup;
  setup.part.faces = {test::plane_face("F1", 40.0, 40.0)};
  setup.targets = {0};
  setup.tolerance_mm = 0.01;
  setup.standing = {box_without_floor()};
  std::vector<FaceSamples> samples = target_samples(setup, 0.5);
  const double radius = 1.0;
  TargetReach(setup, {.radius_mm = radius}, samples).fill(0, samples[0]);
  double free = 0.0;
  for (std::size_t k = 0; k < samples[0].points.size(); ++k) free += samples[0].areas[k] * samples[0].reachable[k];
  // The ball stands off the walls all round, by its radius less the tolerance.
  const double off = radius - 0.01, pi = 3.14159265358979323846;
  EXPECT_NEAR(free, 1600.0 - (200.0 + 2.0 * off * 30.0 + pi * off * off), 2.0);
}

}  // namespace
}  // namespace flank::internal
