// Distances between the corners of a grid, against the tree.
#include "flank/geom/distance_grid.h"

#include <gtest/gtest.h>

#include <cmath>

#include "flank/base/parallel.h"
#include "flank/base/random.h"

namespace flank::internal {
namespace {

Vec3 random_point(Random& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

/// Some hundred small triangles all over the place.
TriangleMesh scattered() {
  Random random(5);
  TriangleMesh mesh;
  for (int k = 0; k < 300; ++k) {
    const Vec3 at = random_point(random, 10.0);
    for (int i = 0; i < 3; ++i) mesh.vertices.push_back(at + random_point(random, 1.0));
    mesh.triangles.push_back({3 * k, 3 * k + 1, 3 * k + 2});
  }
  return mesh;
}

Box3 box_of(double half) { return {Vec3::Constant(-half), Vec3::Constant(half)}; }

TEST(DistanceGrid, IsNoFartherOffThanItSays) {
  const TriangleBvh tree(scattered());
  const DistanceGrid grid(tree, box_of(11.0), 4.0, 0.3);
  Random random(6);
  double sum = 0.0;
  constexpr int kPlaces = 4000;
  for (int k = 0; k < kPlaces; ++k) {
    const Vec3 p = random_point(random, 17.0);
    const double exact = std::sqrt(tree.closest(p).squared_distance), off = std::abs(grid.at(p) - exact),
                 most = exact < grid.far_mm() ? grid.most_off() : 8.0 * grid.most_off();
    EXPECT_LE(off, most + 1e-5);
    EXPECT_LE(grid.at_least(p), exact + 1e-5);
    EXPECT_GE(grid.at_least(p), std::min(exact - 2.0 * most - 1e-5, 3.9));
    sum += off;
  }
  EXPECT_LT(sum / kPlaces, 0.2 * grid.most_off());
}

TEST(DistanceGrid, IsExactBesideAPlaneAndOutsideItsBox) {
  TriangleMesh mesh;
  mesh.vertices = {{-99.0, -99.0, 0.0}, {99.0, -99.0, 0.0}, {0.0, 99.0, 0.0}};
  mesh.triangles = {{0, 1, 2}};
  const TriangleBvh tree(mesh);
  const DistanceGrid grid(tree, {Vec3(-99.0, -99.0, 0.0), Vec3(99.0, 99.0, 0.0)}, 5.0, 0.4);
  EXPECT_NEAR(grid.at({1.234, -0.77, 2.345}), 2.345, 1e-5);
  EXPECT_NEAR(grid.at({1.234, -0.77, -4.321}), 4.321, 1e-5);
  EXPECT_EQ(grid.at({0.0, 0.0, 9.5}), 9.5);
  EXPECT_EQ(grid.at_least({0.0, 0.0, 9.5}), 9.5);
}

TEST(DistanceGrid, SaysTheSameWhoeverAsksFirst) {
  const TriangleBvh tree(scattered());
  const DistanceGrid one(tree, box_of(11.0), 4.0, 0.3), other(tree, box_of(11.0), 4.0, 0.3);
  Random random(7);
  std::vector<Vec3> places;
  for (int k = 0; k < 2000; ++k) places.push_back(random_point(random, 8.0));
  std::vector<double> found(places.size());
  parallel_for(places.size(), [&](std::size_t k) { found[k] = one.at(places[k]); });
  for (std::size_t k = places.size(); k-- > 0;) EXPECT_EQ(other.at(places[k]), found[k]);
}

}  // namespace
}  // namespace flank::internal
