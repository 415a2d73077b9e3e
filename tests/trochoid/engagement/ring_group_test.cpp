// Rings that are looked at together: which are near enough, and what is open of them.
#include "flank/trochoid/engagement/ring_group.h"

#include <gtest/gtest.h>

#include <cmath>

namespace flank::internal {
namespace {

std::vector<ToolRing> rings_at(const std::vector<double>& heights) {
  std::vector<ToolRing> rings(heights.size());
  for (std::size_t k = 0; k < heights.size(); ++k) rings[k].z = heights[k], rings[k].radius = 5.0 + 0.1 * heights[k];
  return rings;
}

TEST(RingGroup, EndsBeforeARingThatIsTooFarAndBeforeARoundEnd) {
  std::vector<ToolRing> rings = rings_at({0.0, 1.0, 2.0, 3.5, 4.0});
  EXPECT_EQ(end_of_group(rings, 0, 2.0), 3U);
  EXPECT_EQ(end_of_group(rings, 3, 2.0), 5U);
  EXPECT_EQ(end_of_group(rings, 0, 0.5), 1U);
  rings[1].flank = false;
  EXPECT_EQ(end_of_group(rings, 0, 2.0), 1U);
}

TEST(RingGroup, HoldsItsRings) {
  const RingGroup group = group_of(rings_at({1.0, 2.0, 4.0}));
  EXPECT_DOUBLE_EQ(group.z, 2.5);
  EXPECT_DOUBLE_EQ(group.half_z, 1.5);
  EXPECT_DOUBLE_EQ(group.radius, 5.25);
  EXPECT_NEAR(group.half_radius, 0.15, 1e-12);
}

TEST(OpenSectors, WhatMeetsIsOneWhereverItsAnglesAreCounted) {
  constexpr double kTurn = 6.283185307179586;
  OpenSectors sectors;
  std::vector<OpenArc> arcs;
  sectors.add(-0.2, 0.3);
  sectors.add(kTurn + 0.1, kTurn + 0.5);
  sectors.add(1.5, 2.0);
  sectors.arcs_on(2.0, arcs);
  ASSERT_EQ(arcs.size(), 2U);
  EXPECT_NEAR(arcs[0].from.y(), 2.0 * std::sin(-0.2), 1e-12);
  EXPECT_NEAR(arcs[0].to.y(), 2.0 * std::sin(0.5), 1e-12);
  EXPECT_FALSE(arcs[0].wide);
  sectors.add(1.9, 5.2);
  sectors.arcs_on(2.0, arcs);
  EXPECT_TRUE(arcs[1].wide);
  sectors.clear();
  sectors.arcs_on(2.0, arcs);
  EXPECT_TRUE(arcs.empty());
}

}  // namespace
}  // namespace flank::internal
