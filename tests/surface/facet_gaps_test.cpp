// Meshes too coarse for a tolerance are told from fine ones, and from surfaces.
#include "flank/surface/facet_gaps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

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

/// A cylinder of radius 20 in flat strips of 2 degrees; every other one is a fan about a place a thousandth of a strip beside the
/// middle of its side, so that slivers lie there.
TriangleMesh strips_with_slivers() {
  constexpr int kStrips = 24;
  constexpr double kStep = 2.0 * std::numbers::pi / 180.0, kHigh = 8.0, kBeside = 1e-3;
  const auto at = [&](double k, double z) { return Vec3(20.0 * std::cos(kStep * k), 20.0 * std::sin(kStep * k), z); };
  TriangleMesh mesh;
  for (int k = 0; k <= kStrips; ++k) mesh.vertices.insert(mesh.vertices.end(), {at(k, 0.0), at(k, kHigh)});
  for (int k = 0; k < kStrips; ++k) {
    const int a = 2 * k, b = 2 * k + 2, c = 2 * k + 3, d = 2 * k + 1;
    if (k % 2 == 0) {
      mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {a, c, d}});
      continue;
    }
    const int middle = static_cast<int>(mesh.vertices.size());
    mesh.vertices.push_back(0.5 * (at(k, 0.0) + at(k, kHigh)) + kBeside * (at(k + 1, 0.0) - at(k, 0.0)));
    mesh.triangles.insert(mesh.triangles.end(), {{a, b, middle}, {b, c, middle}, {c, d, middle}, {d, a, middle}});
  }
  return mesh;
}

TEST(FacetGaps, AreNotThoseOfSlivers) {
  // Strips stand off the cylinder by 20 (1 - cos 1 degree) = 0.003 mm.
  const FacetGaps gaps = facet_gaps(*make_target(strips_with_slivers()), 0.02);
  EXPECT_LT(gaps.largest_mm, 0.02);
  EXPECT_EQ(gaps.share, 0.0);
}

TEST(FacetGaps, LeaveNothingWhereTheyAreTwoTolerancesDeep) {
  const std::unique_ptr<Target> coarse = make_target(shapes::sphere(10, 6));
  const double middles = facet_gaps(*coarse, 0.15).share;
  ASSERT_GT(middles, 0.01);
  EXPECT_DOUBLE_EQ(coverage_bound_by_facets(*coarse, 0.075), 1.0 - middles);
  EXPECT_EQ(coverage_bound_by_facets(*coarse, 0.1), 1.0) << "a motion that cuts and leaves 0.1 mm finishes all of them";
}

}  // namespace
}  // namespace flank::internal
