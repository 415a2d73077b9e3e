// The closest point of one triangle: dense search, regions, degenerate triangles, invariances; small and odd trees.
// mesh_closest_test.cpp holds the tree on whole meshes against brute force.
#include "flank/geom/triangle_bvh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "flank/base/random.h"

namespace flank::internal {
namespace {

Vec3 random_point(Random& random, double size) {
  return {random.uniform(-size, size), random.uniform(-size, size), random.uniform(-size, size)};
}

/// Least distance over a grid of barycentric weights.
double dense_distance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  constexpr int kSteps = 120;
  double least = 1e300;
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; i + j <= kSteps; ++j)
      least = std::min(least, (a + (b - a) * i / kSteps + (c - a) * j / kSteps - p).norm());
  return least;
}

void expect_consistent(const TrianglePoint& found, const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  EXPECT_LT((found.point - (a + found.u * (b - a) + found.v * (c - a))).norm(), 1e-12);
  EXPECT_NEAR(found.squared_distance, (found.point - p).squaredNorm(), 1e-11);
  EXPECT_GE(found.u, 0.0);
  EXPECT_GE(found.v, 0.0);
  EXPECT_LE(found.u + found.v, 1.0 + 1e-15);
}

TEST(ClosestOnTriangle, IsNearerThanEveryGridPointAndNoNearerThanItsSpacing) {
  Random random(1);
  for (int k = 0; k < 60; ++k) {
    const Vec3 a = random_point(random, 3), b = random_point(random, 3), c = random_point(random, 3),
               p = random_point(random, 6);
    const TrianglePoint found = closest_on_triangle(p, a, b, c);
    expect_consistent(found, p, a, b, c);
    const double dense = dense_distance(p, a, b, c), longest = std::max((b - a).norm(), (c - a).norm());
    EXPECT_LE(std::sqrt(found.squared_distance), dense + 1e-12);
    EXPECT_GE(std::sqrt(found.squared_distance), dense - 2.0 * longest / 120.0);
  }
}

/// The conditions of a minimum: p - point is across the plane inside, turned outwards on a side, in the corner's cone.
TEST(ClosestOnTriangle, NoCornerOfTheTriangleLiesOnTheNearSideOfTheTangentPlane) {
  Random random(2);
  for (int k = 0; k < 2000; ++k) {
    const Vec3 a = random_point(random, 3), b = random_point(random, 3), c = random_point(random, 3),
               p = random_point(random, 8);
    const Vec3 q = closest_on_triangle(p, a, b, c).point;
    for (const Vec3& corner : {a, b, c}) EXPECT_LE((p - q).dot(corner - q), 1e-11);
  }
}

TEST(ClosestOnTriangle, KnowsItsSevenRegions) {
  const Vec3 a(0, 0, 0), b(4, 0, 0), c(0, 4, 0);
  const auto at = [&](double x, double y) { return closest_on_triangle(Vec3(x, y, 3), a, b, c).point; };
  EXPECT_EQ(at(1, 1), Vec3(1, 1, 0));
  EXPECT_EQ(at(-1, -2), a);
  EXPECT_EQ(at(6, -1), b);
  EXPECT_EQ(at(-1, 7), c);
  EXPECT_EQ(at(1, -5), Vec3(1, 0, 0));
  EXPECT_EQ(at(-5, 3), Vec3(0, 3, 0));
  EXPECT_LT((at(4, 4) - Vec3(2, 2, 0)).norm(), 1e-15);
  EXPECT_EQ(at(4, 0), b) << "on a corner";
  EXPECT_EQ(at(2, 0), Vec3(2, 0, 0)) << "on a side";
}

TEST(ClosestOnTriangle, DoesNotDependOnTheOrderOfTheCorners) {
  Random random(3);
  for (int k = 0; k < 300; ++k) {
    const Vec3 a = random_point(random, 3), b = random_point(random, 3), c = random_point(random, 3),
               p = random_point(random, 6);
    const Vec3 first = closest_on_triangle(p, a, b, c).point;
    for (const Vec3& other : {closest_on_triangle(p, b, c, a).point, closest_on_triangle(p, c, b, a).point})
      EXPECT_LT((other - first).norm(), 1e-11);
  }
}

TEST(ClosestOnTriangle, MovesWithTheTriangle) {
  Random random(4);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(2.0, Vec3(1, 1, -3).normalized()).toRotationMatrix();
  const Vec3 shift(10, -20, 30);
  const auto move = [&](const Vec3& x) -> Vec3 { return turn * x + shift; };
  for (int k = 0; k < 300; ++k) {
    const Vec3 a = random_point(random, 3), b = random_point(random, 3), c = random_point(random, 3),
               p = random_point(random, 6);
    EXPECT_LT(
        (closest_on_triangle(move(p), move(a), move(b), move(c)).point - move(closest_on_triangle(p, a, b, c).point))
            .norm(),
        1e-10);
  }
}

TEST(ClosestOnTriangle, WithoutAreaIsAPointOrASegment) {
  const Vec3 a(1, 2, 3), b(5, 2, 3);
  for (const Vec3& p : {Vec3(0, 0, 0), Vec3(3, 7, 3), Vec3(9, 2, 4)}) {
    EXPECT_EQ(closest_on_triangle(p, a, a, a).point, a);
    const Vec3 expected(std::clamp(p[0], 1.0, 5.0), 2, 3);
    for (const TrianglePoint& found : {closest_on_triangle(p, a, b, b), closest_on_triangle(p, a, a, b),
                                       closest_on_triangle(p, b, a, b), closest_on_triangle(p, a, b, Vec3(3, 2, 3))}) {
      EXPECT_TRUE(found.point.allFinite());
      EXPECT_LT((found.point - expected).norm(), 1e-12) << p.transpose();
      EXPECT_NEAR(found.squared_distance, (expected - p).squaredNorm(), 1e-12);
    }
  }
}

TriangleMesh soup(int triangles, std::uint64_t seed) {
  Random random(seed);
  TriangleMesh mesh;
  for (int t = 0; t < triangles; ++t) {
    const Vec3 at = random_point(random, 10);
    const int first = static_cast<int>(mesh.vertices.size());
    for (int k = 0; k < 3; ++k) mesh.vertices.push_back(at + random_point(random, 2));
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

double brute(const TriangleMesh& mesh, const Vec3& p) {
  double least = 1e300;
  for (const auto& [a, b, c] : mesh.triangles)
    least = std::min(least, closest_on_triangle(p, mesh.vertices[static_cast<std::size_t>(a)],
                                                mesh.vertices[static_cast<std::size_t>(b)],
                                                mesh.vertices[static_cast<std::size_t>(c)])
                                .squared_distance);
  return least;
}

/// Every size that fills a group, a node or a level, and one more.
TEST(TriangleBvh, IsExactForEverySmallNumberOfTriangles) {
  Random random(5);
  for (const int count : {1, 2, 3, 4, 5, 7, 8, 9, 15, 31, 32, 33, 34, 63, 65, 255, 257}) {
    const TriangleMesh mesh = soup(count, static_cast<std::uint64_t>(count));
    const TriangleBvh tree(mesh);
    for (int k = 0; k < 40; ++k) {
      const Vec3 p = random_point(random, 15);
      EXPECT_EQ(tree.closest(p).squared_distance, brute(mesh, p)) << count << " triangles";
    }
  }
}

TEST(TriangleBvh, TakesManyTrianglesAtOnePlace) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles.assign(500, {0, 1, 2});
  const TriangleBvh tree(mesh);
  const BvhHit hit = tree.closest(Vec3(0.25, 0.25, -2.0));
  EXPECT_EQ(hit.squared_distance, 4.0);
  EXPECT_GE(hit.triangle, 0);
  BvhTies ties;
  (void)tree.closest(Vec3(0.25, 0.25, -2.0), 1e-3, ties);
  EXPECT_FALSE(ties.complete) << "500 ties do not fit";
  EXPECT_LE(ties.count, BvhTies::kCapacity);
}

TEST(TriangleBvh, TiesAreThoseWithinTheSlackAndNeverTwice) {
  const TriangleMesh mesh = soup(60, 6);
  const TriangleBvh tree(mesh);
  Random random(7);
  for (int k = 0; k < 60; ++k) {
    const Vec3 p = random_point(random, 12);
    BvhTies none, some;
    const BvhHit hit = tree.closest(p, 0.0, none);
    (void)tree.closest(p, 1.5, some);
    ASSERT_TRUE(some.complete);
    const std::set<int> found(some.triangle.begin(), some.triangle.begin() + some.count);
    EXPECT_EQ(found.size(), static_cast<std::size_t>(some.count));
    EXPECT_TRUE(found.contains(hit.triangle));
    EXPECT_GE(none.count, 1);
    EXPECT_LE(none.count, some.count);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto corner = [&](std::size_t c) { return mesh.vertices[static_cast<std::size_t>(mesh.triangles[t][c])]; };
      const double d = std::sqrt(closest_on_triangle(p, corner(0), corner(1), corner(2)).squared_distance);
      if (d <= std::sqrt(hit.squared_distance) + 1.5) {
        EXPECT_TRUE(found.contains(static_cast<int>(t)));
      }
    }
  }
}

TEST(TriangleBvh, WithinALimitItFindsTheSameOrNothing) {
  Random random(11);
  TriangleMesh mesh;
  for (int k = 0; k < 200; ++k) {
    const Vec3 at = random_point(random, 20.0);
    for (int i = 0; i < 3; ++i) mesh.vertices.push_back(at + random_point(random, 2.0));
    mesh.triangles.push_back({3 * k, 3 * k + 1, 3 * k + 2});
  }
  const TriangleBvh tree(mesh);
  for (int k = 0; k < 500; ++k) {
    const Vec3 p = random_point(random, 30.0);
    const BvhHit all = tree.closest(p);
    const double distance = std::sqrt(all.squared_distance);
    for (const double most : {0.0, 0.5 * distance, distance * (1.0 + 1e-12), 2.0 * distance + 1.0}) {
      const BvhHit near = tree.closest_within(p, most);
      EXPECT_EQ(near.triangle, distance <= most ? all.triangle : -1);
      EXPECT_EQ(near.squared_distance, distance <= most ? all.squared_distance : most * most);
    }
  }
}

TEST(TriangleBvh, DistanceKeepsUnderScalingByPowersOfTwo) {
  const TriangleMesh mesh = soup(80, 8);
  TriangleMesh large = mesh, tiny = mesh;
  for (Vec3& x : large.vertices) x *= 1024.0;
  for (Vec3& x : tiny.vertices) x *= 0x1.0p-20;
  const TriangleBvh tree(mesh), large_tree(large), tiny_tree(tiny);
  Random random(9);
  for (int k = 0; k < 50; ++k) {
    const Vec3 p = random_point(random, 12);
    const double d = std::sqrt(tree.closest(p).squared_distance);
    EXPECT_EQ(std::sqrt(large_tree.closest(1024.0 * p).squared_distance), 1024.0 * d);
    EXPECT_EQ(std::sqrt(tiny_tree.closest(0x1.0p-20 * p).squared_distance), 0x1.0p-20 * d);
  }
}

}  // namespace
}  // namespace flank::internal
