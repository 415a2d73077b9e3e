// Rings that move on from row to row: together they are the tool, and those of the engagement stay.
#include "flank/trochoid/engagement/row_rings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <utility>
#include <vector>

namespace flank::internal {
namespace {

const RadialFunction kCone(ToolFamily::kCone, 20.0, Eigen::Vector2d(3.0, 0.1));

TEST(RowRings, AreasAddUpToTheToolsSurface) {
  constexpr int kRows = 89;
  const RowRings rings(kCone, 5, 9);
  double area = 0.0, end_areas = 0.0;
  for (std::size_t row = 0; row < kRows; ++row)
    for (const ToolRing& ring : rings.of(row)) (ring.flank ? area : end_areas) += 2.0 * std::numbers::pi * ring.area;
  const double pi = std::numbers::pi, slope = std::sin(0.1), low = 3.0, high = 3.0 + 20.0 * slope;
  EXPECT_NEAR(area / kRows / (2.0 * pi * (1.0 - slope * slope) * 20.0 * 0.5 * (low + high)), 1.0, 1e-9);
  EXPECT_NEAR(end_areas / kRows / (2.0 * pi * (low * low * (1.0 - slope) + high * high * (1.0 + slope))), 1.0, 1e-2);
}

TEST(RowRings, ThoseOfTheEngagementAreTheSameInEachRow) {
  const RowRings rings(kCone, 5, 9);
  for (std::size_t row = 0; row < 20; ++row) {
    std::vector<double> asked;
    for (const ToolRing& ring : rings.of(row))
      if (ring.asked && ring.flank) asked.push_back(ring.s);
    EXPECT_EQ(asked, (std::vector<double>{0.0, 5.0, 10.0, 15.0, 20.0}));
  }
}

TEST(RowRings, AllButSomeAreBetweenOthers) {
  const RowRings rings(kCone, 8, 5, 3);
  std::vector<double> first;
  for (const ToolRing& ring : rings.of(0)) {
    EXPECT_FALSE(ring.between && !ring.asked);
    if (ring.asked && ring.flank && !ring.between) first.push_back(ring.s);
  }
  const double apart = 20.0 / 7.0;
  ASSERT_EQ(first.size(), 4u);
  for (const auto& [k, s] : {std::pair{0u, 0.0}, {1u, 3.0}, {2u, 6.0}, {3u, 7.0}})
    EXPECT_NEAR(first[k], s * apart, 1e-12);
}

TEST(RowRings, ThoseOfTheVolumeAreNeverWhereTheyHaveJustBeen) {
  const RowRings rings(kCone, 0, 4);
  std::vector<double> places;
  for (std::size_t row = 0; row < 89; ++row)
    for (const ToolRing& ring : rings.of(row))
      if (ring.flank) places.push_back(ring.s);
  std::sort(places.begin(), places.end());
  ASSERT_EQ(places.size(), 4u * 89u);
  for (std::size_t k = 1; k < places.size(); ++k) EXPECT_NEAR(places[k] - places[k - 1], 20.0 / (4.0 * 89.0), 1e-9);
}

TEST(RowRings, OfRoundEndsAreAsNearAsThoseOfTheFlank) {
  const auto ends = [](double length) {
    const RowRings rings(RadialFunction(ToolFamily::kCylinder, length, Eigen::VectorXd::Constant(1, 4.0)), 0, 10);
    return std::count_if(rings.of(0).begin(), rings.of(0).end(), [](const ToolRing& ring) { return !ring.flank; });
  };
  // The quarter of a meridian of 4 mm is 6.3 mm long.
  EXPECT_EQ(ends(60.0), 2 * 2);
  EXPECT_EQ(ends(20.0), 2 * 4);
  EXPECT_EQ(ends(200.0), 2 * 1) << "one at least";
}

}  // namespace
}  // namespace flank::internal
