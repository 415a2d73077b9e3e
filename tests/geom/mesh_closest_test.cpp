// The tree over triangles against every triangle, in double precision.
#include <gtest/gtest.h>

#include "flank/base/random.h"
#include "flank/geom/triangle_bvh.h"
#include "surface/mesh_shapes.h"

namespace flank::internal {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int kPoints = 60;
#else
constexpr int kPoints = 600;
#endif

double brute(const TriangleMesh& mesh, const Vec3& p) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& t : mesh.triangles) {
    const auto at = [&](int k) -> const Vec3& { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
    least = std::min(least, closest_on_triangle(p, at(0), at(1), at(2)).squared_distance);
  }
  return least;
}

void expect_exact(const TriangleMesh& mesh, double scale, const Vec3& about, std::uint64_t seed) {
  const TriangleBvh tree(mesh);
  Random random(seed);
  for (int i = 0; i < kPoints; ++i) {
    Vec3 p = about + scale * Vec3(random.normal(), random.normal(), random.normal());
    if (i % 3 == 0)
      p = mesh.vertices[random.next() % mesh.vertices.size()] +
          1e-3 * scale * Vec3(random.normal(), 0, random.normal());
    if (i % 50 == 0) p = mesh.vertices[random.next() % mesh.vertices.size()];
    const BvhHit hit = tree.closest(p);
    EXPECT_EQ(hit.squared_distance, brute(mesh, p)) << "point " << i << ": " << p.transpose();
    const auto& t = mesh.triangles[static_cast<std::size_t>(hit.triangle)];
    const Vec3& a = mesh.vertices[static_cast<std::size_t>(t[0])];
    const Vec3 from_weights = a + hit.u * (mesh.vertices[static_cast<std::size_t>(t[1])] - a) +
                              hit.v * (mesh.vertices[static_cast<std::size_t>(t[2])] - a);
    EXPECT_NEAR((from_weights - hit.point).norm(), 0.0, 1e-12 * (1.0 + p.norm()));
  }
}

TEST(TriangleBvh, EqualsBruteForceOnSmoothMeshes) {
  expect_exact(shapes::twisted(40), 30.0, Vec3::Zero(), 1);
  expect_exact(shapes::torus(20, 8, 50, 30), 20.0, Vec3::Zero(), 2);
  expect_exact(shapes::sphere(10, 14), 8.0, Vec3::Zero(), 3);
}

TEST(TriangleBvh, EqualsBruteForceFarFromTheOriginAndFarFromTheMesh) {
  TriangleMesh mesh = shapes::twisted(30);
  for (Vec3& x : mesh.vertices) x += Vec3(5000, -3000, 800);
  expect_exact(mesh, 30.0, Vec3(5000, -3000, 800), 4);
  expect_exact(mesh, 5000.0, Vec3::Zero(), 5);
}

TEST(TriangleBvh, EqualsBruteForceOnASoupOfNeedlesAndSlivers) {
  Random random(6);
  TriangleMesh mesh;
  for (int i = 0; i < 400; ++i) {
    const Vec3 a(random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-5, 5));
    const Vec3 b = a + 3.0 * Vec3(random.normal(), random.normal(), random.normal());
    const double thin = std::pow(10.0, -random.uniform(0.0, 12.0));
    const Vec3 off = thin * Vec3(random.normal(), random.normal(), random.normal());
    const Vec3 c = (i % 2 == 0 ? b : Vec3(a + random.uniform() * (b - a))) + off;
    const int n = static_cast<int>(mesh.vertices.size());
    for (const Vec3& x : {a, b, c}) mesh.vertices.push_back(x);
    mesh.triangles.push_back({n, n + 1, n + 2});
  }
  expect_exact(mesh, 5.0, Vec3::Zero(), 7);
}

TEST(TriangleBvh, SurvivesTheCentreOfASphereAndDegenerateTriangles) {
  TriangleMesh mesh = shapes::sphere(10, 14);
  EXPECT_EQ(TriangleBvh(mesh).closest(Vec3::Zero()).squared_distance, brute(mesh, Vec3::Zero()));
  mesh.triangles.push_back({0, 0, 0});
  mesh.triangles.push_back({0, 1, 0});
  expect_exact(mesh, 10.0, Vec3::Zero(), 8);
  TriangleMesh one;
  one.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  one.triangles = {{0, 1, 2}};
  expect_exact(one, 2.0, Vec3::Zero(), 9);
}

TEST(TriangleBvh, TiesHoldEveryTriangleWithinTheSlack) {
  const TriangleMesh mesh = shapes::torus(20, 8, 50, 30);
  const TriangleBvh tree(mesh);
  Random random(10);
  for (int i = 0; i < kPoints / 4; ++i) {
    const Vec3 p(random.uniform(-30, 30), random.uniform(-30, 30), random.uniform(-10, 10));
    BvhTies ties;
    const BvhHit hit = tree.closest(p, 0.05, ties);
    EXPECT_EQ(hit.squared_distance, brute(mesh, p));
    if (!ties.complete) continue;
    const std::vector<int> found(ties.triangle.begin(), ties.triangle.begin() + ties.count);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto at = [&](int k) -> const Vec3& {
        return mesh.vertices[static_cast<std::size_t>(mesh.triangles[t][k])];
      };
      if (std::sqrt(closest_on_triangle(p, at(0), at(1), at(2)).squared_distance) >
          std::sqrt(hit.squared_distance) + 0.05)
        continue;
      EXPECT_TRUE(std::find(found.begin(), found.end(), static_cast<int>(t)) != found.end());
    }
  }
}

}  // namespace
}  // namespace flank::internal
