// Boxes over triangles: nothing outside its box, nothing twice, and a search through them finds what brute force finds.
#include "flank/obstacle/triangle_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "flank/base/random.h"

namespace flank::internal {
namespace {

Vec3 random_point(Random& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

/// `count` small triangles; `surface` numbers them in the order in which they are handed over.
std::vector<TriangleTree::Triangle> scattered(int count, const Vec3& middle, std::uint64_t seed) {
  Random random(seed);
  std::vector<TriangleTree::Triangle> triangles;
  for (int k = 0; k < count; ++k) {
    const Vec3 at = middle + random_point(random, 40.0);
    TriangleTree::Triangle triangle;
    for (Vec3& corner : triangle.corners) corner = at + random_point(random, 2.0);
    triangle.surface = k;
    triangle.slack_mm = 0.001 * ((7 * k) % count);
    triangles.push_back(triangle);
  }
  return triangles;
}

bool is_in(const TriangleTree::Node& node, const Vec3& x) {
  return ((x - node.center).cwiseAbs().array() <= node.half.array()).all();
}

/// A node's triangles lie in its box, its children share them out between them, and leaves are small.
void expect_sound(const TriangleTree& tree, int index) {
  const TriangleTree::Node& node = tree.nodes()[static_cast<std::size_t>(index)];
  for (int k = node.first; k < node.end; ++k)
    for (const Vec3& corner : tree.triangles()[static_cast<std::size_t>(k)].corners)
      ASSERT_TRUE(is_in(node, corner)) << "node " << index << ", triangle " << k;
  if (node.second < 0) {
    EXPECT_LE(node.end - node.first, 4);
    EXPECT_GT(node.end, node.first);
    return;
  }
  const TriangleTree::Node& left = tree.nodes()[static_cast<std::size_t>(index) + 1];
  const TriangleTree::Node& right = tree.nodes()[static_cast<std::size_t>(node.second)];
  EXPECT_EQ(left.first, node.first);
  EXPECT_EQ(left.end, right.first);
  EXPECT_EQ(right.end, node.end);
  EXPECT_LE(std::abs((left.end - left.first) - (right.end - right.first)), 1) << "halves, so that it is not deep";
  expect_sound(tree, index + 1);
  expect_sound(tree, node.second);
}

double box_distance(const TriangleTree::Node& node, const Vec3& x) {
  return ((x - node.center).cwiseAbs() - node.half).cwiseMax(0.0).norm();
}

double corner_distance(const TriangleTree::Triangle& triangle, const Vec3& x) {
  double least = 1e300;
  for (const Vec3& corner : triangle.corners) least = std::min(least, (corner - x).norm());
  return least;
}

/// The nearest corner by the boxes; `visited` counts the triangles that were looked at.
double nearest_by_tree(const TriangleTree& tree, const Vec3& x, int& visited) {
  double least = 1e300;
  std::vector<int> stack = {0};
  while (!stack.empty()) {
    const int index = stack.back();
    stack.pop_back();
    const TriangleTree::Node& node = tree.nodes()[static_cast<std::size_t>(index)];
    if (box_distance(node, x) > least) continue;
    if (node.second >= 0) {
      std::array<int, 2> children = {index + 1, node.second};
      const auto far = [&](int k) { return box_distance(tree.nodes()[static_cast<std::size_t>(k)], x); };
      if (far(children[0]) < far(children[1])) std::swap(children[0], children[1]);
      stack.insert(stack.end(), children.begin(), children.end());
      continue;
    }
    for (int k = node.first; k < node.end; ++k, ++visited)
      least = std::min(least, corner_distance(tree.triangles()[static_cast<std::size_t>(k)], x));
  }
  return least;
}

TEST(TriangleTree, IsEmptyWithoutTriangles) {
  EXPECT_TRUE(TriangleTree().empty());
  const TriangleTree tree{std::vector<TriangleTree::Triangle>{}};
  EXPECT_TRUE(tree.empty());
  EXPECT_TRUE(tree.nodes().empty());
  EXPECT_EQ(tree.largest_slack(), 0.0);
}

TEST(TriangleTree, EveryTriangleIsInTheBoxesAboveItAndInOneLeaf) {
  for (const int count : {1, 4, 5, 8, 9, 100, 777}) {
    const TriangleTree tree(scattered(count, Vec3::Zero(), 5));
    ASSERT_FALSE(tree.empty());
    EXPECT_EQ(tree.nodes().front().first, 0);
    EXPECT_EQ(tree.nodes().front().end, count);
    expect_sound(tree, 0);
  }
}

TEST(TriangleTree, KeepsEveryTriangleAsItWas) {
  const std::vector<TriangleTree::Triangle> given = scattered(300, Vec3::Zero(), 9);
  const TriangleTree tree(given);
  std::vector<TriangleTree::Triangle> kept = tree.triangles();
  ASSERT_EQ(kept.size(), given.size());
  std::sort(kept.begin(), kept.end(), [](const auto& a, const auto& b) { return a.surface < b.surface; });
  for (std::size_t k = 0; k < given.size(); ++k) {
    EXPECT_EQ(kept[k].surface, given[k].surface);
    EXPECT_EQ(kept[k].slack_mm, given[k].slack_mm);
    EXPECT_EQ(kept[k].corners, given[k].corners);
  }
  EXPECT_EQ(tree.largest_slack(), 0.299);
}

TEST(TriangleTree, RoundingLetsNoCornerOutFarFromTheOrigin) {
  for (const double far : {1e3, 1e6, 1e9}) {
    const TriangleTree tree(scattered(200, Vec3(far, -0.3 * far, 0.7 * far), 21));
    expect_sound(tree, 0);
  }
}

TEST(TriangleTree, ASearchThroughItFindsTheNearest) {
  const TriangleTree tree(scattered(1000, Vec3(10.0, 0.0, -5.0), 33));
  Random random(2);
  int visited = 0;
  constexpr int kQueries = 100;
  for (int i = 0; i < kQueries; ++i) {
    const Vec3 x = Vec3(10.0, 0.0, -5.0) + random_point(random, 60.0);
    double brute = 1e300;
    for (const TriangleTree::Triangle& triangle : tree.triangles())
      brute = std::min(brute, corner_distance(triangle, x));
    EXPECT_EQ(nearest_by_tree(tree, x, visited), brute);
  }
  EXPECT_LT(visited, kQueries * 200) << "a fifth of all triangles at most: else the boxes are of no use";
}

TEST(TriangleTree, DividesTrianglesThatShareTheirMiddle) {
  // All alike: no direction separates them, and the halves are halves all the same.
  std::vector<TriangleTree::Triangle> triangles(50);
  for (TriangleTree::Triangle& triangle : triangles) triangle.corners = {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  const TriangleTree tree(triangles);
  expect_sound(tree, 0);
}

TEST(TriangleTree, TakesPointsAsTriangles) {
  std::vector<TriangleTree::Triangle> triangles;
  for (int k = 0; k < 64; ++k) {
    const Vec3 x(k % 4, k / 4 % 4, k / 16);
    triangles.push_back({{x, x, x}, k, 0.25});
  }
  const TriangleTree tree(triangles);
  expect_sound(tree, 0);
  EXPECT_EQ(tree.largest_slack(), 0.25);
  int visited = 0;
  EXPECT_NEAR(nearest_by_tree(tree, Vec3(1.1, 2.0, 3.0), visited), 0.1, 1e-12);
}

}  // namespace
}  // namespace flank::internal
