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

/// What `wanted` is after a close look at the rings that are not between others: rough and exact angles of all of them.
std::vector<std::size_t> wanted_between(const std::vector<double>& rough, const std::vector<double>& exact) {
  std::vector<ToolRing> rings(rough.size());
  for (std::size_t k = 0; k < rings.size(); ++k) rings[k].between = k % 3 != 0;
  WantedRings wanted;
  wanted.begin(rings);
  std::vector<RingArc> found;
  for (std::size_t k = 0; k < rings.size(); ++k) {
    EXPECT_EQ(wanted[k], k % 3 == 0);
    if (wanted[k] && exact[k] > 0.0) found.push_back({k, 0.0, {-0.5 * exact[k], 0.5 * exact[k]}});
  }
  const bool some = wanted.go_on(
      rings, [&](std::size_t k) { return rough[k]; }, found);
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < rings.size(); ++k)
    if (wanted[k]) out.push_back(k);
  EXPECT_EQ(some, !out.empty());
  return out;
}

TEST(WantedRings, AreThoseThatARoughLookLeavesMoreOpenThanTheLargest) {
  using Some = std::vector<std::size_t>;
  // Where a rough look sees it all, the close one adds nothing but what is larger.
  EXPECT_EQ(wanted_between({0.9, 0.95, 0.99, 1.0, 1.02, 0.98, 0.8}, {0.9, 0.0, 0.0, 1.0, 0.0, 0.0, 0.8}), (Some{4}));
  // It leaves 0.004 and 0.006 too much beside a ring: with 0.004 less the first one may still be the largest.
  EXPECT_EQ(wanted_between({0.904, 1.005, 1.004, 1.006}, {0.9, 0.0, 0.0, 1.0}), (Some{1}));
  // Where it leaves much too much beside them, nothing is known of the others.
  EXPECT_EQ(wanted_between({1.0, 1.11, 1.09, 1.2}, {0.9, 0.0, 0.0, 1.0}), (Some{1, 2}));
  // A peak of which the rings beside have nothing.
  EXPECT_EQ(wanted_between({0.0, 0.0, 1.3, 0.0, 0.2, 0.3, 0.5}, {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.5}), (Some{2}));
  EXPECT_EQ(wanted_between({1.0, 1.0, 1.0, 1.0}, {1.0, 0.0, 0.0, 1.0}), Some{});
}

}  // namespace
}  // namespace flank::internal
