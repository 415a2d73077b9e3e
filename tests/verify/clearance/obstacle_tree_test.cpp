#include "flank/verify/clearance/obstacle_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <set>

#include "verify/clearance/clearance_fixture.h"

namespace flank::internal::verify {
namespace {

/// Triangles of all sizes anywhere: some without area, some far from the others.
TriangleMesh soup(std::uint64_t seed, int count) {
  Random random(seed);
  TriangleMesh mesh;
  for (int i = 0; i < count; ++i) {
    const Vec3 middle = random_point(random, i % 7 == 0 ? 500.0 : 20.0);
    const double size = std::pow(10.0, random.uniform(-3.0, 1.0));
    for (int k = 0; k < 3; ++k) mesh.vertices.push_back(middle + random_point(random, size));
    mesh.triangles.push_back({3 * i, 3 * i + 1, i % 11 == 0 ? 3 * i : 3 * i + 2});
  }
  return mesh;
}

TEST(ObstacleTree, HoldsEveryTriangleOnceAsItWas) {
  const TriangleMesh mesh = soup(1, 777);
  const ObstacleTree tree(mesh);
  std::set<int> seen;
  for (int i = 0; i < 777; ++i) {
    seen.insert(tree.number(i));
    const auto& t = mesh.triangles[static_cast<std::size_t>(tree.number(i))];
    for (std::size_t k = 0; k < 3; ++k) ASSERT_EQ(tree.corners(i)[k], mesh.vertices[static_cast<std::size_t>(t[k])]);
  }
  EXPECT_EQ(seen.size(), 777u);
  EXPECT_EQ(*seen.rbegin(), 776);
}

TEST(ObstacleTree, SpheresAndSlabsHoldWhatTheyShould) {
  const ObstacleTree tree(soup(2, 500));
  for (int n = 0; n < tree.node_count(); ++n) {
    const ObstacleTree::Node& node = tree.node(n);
    ASSERT_NEAR(node.normal.norm(), 1.0, 1e-12);
    bool at_low = false, at_high = false;
    for (int i = node.first; i < node.end; ++i) {
      for (const Vec3& x : tree.corners(i)) {
        ASSERT_LE((x - node.sphere.center).norm(), node.sphere.radius);
        ASSERT_LE((x - tree.sphere(i).center).norm(), tree.sphere(i).radius);
        const double height = node.normal.dot(x);
        ASSERT_GE(height, node.low - 1e-12);
        ASSERT_LE(height, node.high + 1e-12);
        at_low |= height <= node.low + 1e-12;
        at_high |= height >= node.high - 1e-12;
      }
    }
    EXPECT_TRUE(at_low && at_high) << "the slab is no thicker than it must be";
  }
}

TEST(ObstacleTree, ChildrenShareTheirParentsTriangles) {
  const ObstacleTree tree(soup(3, 500));
  EXPECT_EQ(tree.node(0).first, 0);
  EXPECT_EQ(tree.node(0).end, 500);
  int leaves = 0, most = 0;
  for (int n = 0; n < tree.node_count(); ++n) {
    const ObstacleTree::Node& node = tree.node(n);
    if (node.second < 0) {
      ++leaves;
      most = std::max(most, node.end - node.first);
      continue;
    }
    const ObstacleTree::Node &a = tree.node(n + 1), &b = tree.node(node.second);
    ASSERT_EQ(a.first, node.first);
    ASSERT_EQ(a.end, b.first);
    ASSERT_EQ(b.end, node.end);
    ASSERT_LE(std::abs((a.end - a.first) - (b.end - b.first)), 1) << "halves";
  }
  EXPECT_LE(most, 3);
  EXPECT_EQ(tree.node_count(), 2 * leaves - 1);
}

TEST(ObstacleTree, ATrianglesSphereIsTheSmallestForRightAndBluntOnes) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {6, 0, 0}, {0, 8, 0}, {0, 0, 0}, {10, 0, 0}, {5, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  const ObstacleTree tree(mesh);
  for (int i = 0; i < 2; ++i) EXPECT_NEAR(tree.sphere(i).radius, 5.0, 1e-9);
}

TEST(ObstacleTree, AFlatPieceHasASlabAcrossItWhicheverWayItIsOriented) {
  TriangleMesh plane;
  const Vec3 n = Vec3(1, 2, 2).normalized(), e = n.unitOrthogonal(), f = n.cross(e);
  for (int i = 0; i <= 10; ++i)
    for (int j = 0; j <= 10; ++j) plane.vertices.push_back(7.0 * n + i * e + j * f);
  for (int i = 0; i < 10; ++i) {
    for (int j = 0; j < 10; ++j) {
      const int a = 11 * i + j;
      plane.triangles.push_back({a, a + 11, a + 12});
      plane.triangles.push_back((i + j) % 2 == 0 ? std::array<int, 3>{a, a + 12, a + 1}
                                                 : std::array<int, 3>{a, a + 1, a + 12});
    }
  }
  const ObstacleTree tree(plane);
  for (int k = 0; k < tree.node_count(); ++k) {
    const ObstacleTree::Node& node = tree.node(k);
    ASSERT_TRUE(node.flat) << k;
    ASSERT_NEAR(std::abs(node.normal.dot(n)), 1.0, 1e-12);
    ASSERT_NEAR(node.low * (node.normal.dot(n) > 0.0 ? 1.0 : -1.0), 7.0, 1e-12);
    ASSERT_NEAR(node.high, node.low, 1e-12);
  }
  TriangleMesh corner = square(5.0, 0.0);
  corner.vertices.push_back({0, 0, 9});
  corner.triangles.push_back({0, 1, 4});
  EXPECT_FALSE(ObstacleTree(corner).node(0).flat);
}

TEST(ObstacleTree, NoTrianglesMakeAnEmptyTree) {
  EXPECT_TRUE(ObstacleTree().empty());
  EXPECT_TRUE(ObstacleTree(TriangleMesh()).empty());
  EXPECT_EQ(ObstacleTree(TriangleMesh()).node_count(), 0);
}

TEST(ObstacleTree, TrianglesInOnePlaceDoNotSplitForEver) {
  TriangleMesh mesh;
  mesh.vertices = {{1, 1, 1}, {2, 1, 1}, {1, 2, 1}};
  mesh.triangles.assign(1000, {0, 1, 2});
  const ObstacleTree tree(mesh);
  EXPECT_LT(tree.node_count(), 1024);
  EXPECT_NEAR(tree.node(0).sphere.radius, std::sqrt(0.5), 1e-9);
}

}  // namespace
}  // namespace flank::internal::verify
