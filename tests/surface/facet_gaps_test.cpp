// Meshes too coarse for a tolerance are told from fine ones, and from surfaces.
#include "flank/surface/facet_gaps.h"

#include <gtest/gtest.h>

#include <memory>

#include "surface/jet_surfaces.h"

namespace flank::internal {
namespace {

TEST(FacetGaps, AreThoseOfChords) {
  // A ball of radius 10 in cells of 15 degrees, 21 across: the longest chord is 10 (1 - cos 10.6 degrees) = 0.17 mm deep.
  const std::unique_ptr<Target> coarse = make_target(shapes::sphere(10, 6));
  const FacetGaps gaps = facet_gaps(*coarse, 0.05);
  EXPECT_NEAR(gaps.largest_mm, 0.17, 0.01);
  EXPECT_GT(gaps.share, 0.5);
  EXPECT_EQ(facet_gaps(*coarse, 1.0).share, 0.0);
  const FacetGaps fine = facet_gaps(*make_target(shapes::sphere(10, 60)), 0.05);
  EXPECT_LT(fine.largest_mm, 0.02);
  EXPECT_EQ(fine.share, 0.0);
}

TEST(FacetGaps, LeaveNothingWhereTheyAreTwoTolerancesDeep) {
  const std::unique_ptr<Target> coarse = make_target(shapes::sphere(10, 6));
  const double middles = facet_gaps(*coarse, 0.15).share;
  ASSERT_GT(middles, 0.01);
  EXPECT_DOUBLE_EQ(most_of_facets(*coarse, 0.075), 1.0 - middles);
  EXPECT_EQ(most_of_facets(*coarse, 0.1), 1.0) << "a motion that cuts and leaves 0.1 mm finishes all of them";
}

}  // namespace
}  // namespace flank::internal
