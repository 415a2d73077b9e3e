#include "flank/surface/facets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "flank/base/random.h"
#include "flank/error.h"
#include "flank/geom/triangle_bvh.h"
#include "surface/mesh_shapes.h"

namespace flank::internal {
namespace {

/// Half a pipe along v with a radius of 10 mm, whose corners are 0.3 mm off it.
TriangleMesh rough_pipe() {
  Random random(5);
  return shapes::grid(12, 6, [&](double u, double v) {
    const double angle = 3.0 * u, radius = 10.0 + random.uniform(-0.3, 0.3);
    return Vec3(radius * std::cos(angle), radius * std::sin(angle), 30.0 * v);
  });
}

double nearest_triangle(const TriangleMesh& mesh, const Vec3& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto at = [&](int k) { return mesh.vertices[static_cast<std::size_t>(k)]; };
    least = std::min(least, closest_on_triangle(p, at(a), at(b), at(c)).squared_distance);
  }
  return std::sqrt(least);
}

TEST(Facets, DistancesAreThoseOfTheTriangles) {
  const TriangleMesh mesh = rough_pipe();
  const auto facets = make_facets(mesh);
  Random random(6);
  for (int i = 0; i < 500; ++i) {
    const Vec3 p(random.uniform(-15, 15), random.uniform(-5, 15), random.uniform(-5, 35));
    const Footpoint foot = facets->closest(p);
    const double distance = nearest_triangle(mesh, p);
    ASSERT_NEAR(std::abs(foot.distance), distance, 1e-9);
    EXPECT_NEAR((foot.point - p).norm(), distance, 1e-9);
    EXPECT_NEAR(foot.normal.norm(), 1.0, 1e-12);
    EXPECT_EQ(facets->closest_within(p, distance * 0.999).patch, -1);
    EXPECT_EQ(facets->closest_within(p, distance * 1.001).patch, foot.patch);
  }
}

TEST(Facets, TheSideIsToldOnEdgesAndCornersToo) {
  // A roof and a pyramid: the nearest place lies on an edge or on the tip, seen from a triangle's wrong side as well.
  const auto roof = make_facets({{{0, 0, 0}, {10, 0, 0}, {0, 5, -4}, {10, 5, -4}, {0, -5, -4}, {10, -5, -4}},
                                 {{0, 1, 3}, {0, 3, 2}, {0, 4, 5}, {0, 5, 1}}});
  const Footpoint above = roof->closest({5, 0.1, 3}), below = roof->closest({5, 0.1, -1});
  EXPECT_EQ(above.location, Location::kInside);
  EXPECT_NEAR(above.normal.z(), 1.0, 1e-12);
  EXPECT_GT(above.distance, 0.0);
  EXPECT_LT(below.distance, 0.0);
  const auto tip = make_facets({{{0, 0, 5}, {4, 0, 0}, {-2, 3, 0}, {-2, -3, 0}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}}});
  EXPECT_EQ(tip->closest({0.1, 0.1, 7}).location, Location::kInside);
  EXPECT_GT(tip->closest({0.1, 0.1, 7}).distance, 0.0);
  EXPECT_LT(tip->closest({0, 0, 3}).distance, 0.0);
}

TEST(Facets, OpenSidesAreTheBorder) {
  const auto facets = make_facets(rough_pipe());
  EXPECT_EQ(facets->closest({0, 12, -3}).location, Location::kBorder);
  EXPECT_EQ(facets->closest({0, 12, 15}).location, Location::kInside);
  for (const Vec3& p : facets->border_points(1.0)) EXPECT_EQ(facets->closest(p).location, Location::kBorder);
}

TEST(Facets, SamplesStandForTheArea) {
  const auto facets = make_facets(rough_pipe());
  double area = 0.0;
  for (const SurfaceSample& sample : facets->samples(0.7)) {
    area += sample.area;
    EXPECT_NEAR(facets->closest(sample.point).distance, 0.0, 1e-9);
  }
  EXPECT_NEAR(area, facets->area(), 1e-9 * area);
}

TEST(Facets, OneTriangleWillDoAndNoneWillNot) {
  const auto one = make_facets({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}});
  EXPECT_NEAR(one->closest({0.2, 0.2, 3}).distance, 3.0, 1e-12);
  EXPECT_THROW((void)make_facets({}), InputError);
}

}  // namespace
}  // namespace flank::internal
