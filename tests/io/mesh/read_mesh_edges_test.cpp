#include "flank/io/mesh/read_mesh_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "flank/geom/mesh_topology.h"
#include "sanitized.h"
#include "surface/mesh_shapes.h"

namespace flank::internal {
namespace {

using Links = std::vector<std::array<int, 3>>;
constexpr double kSharp = 40.0 * std::numbers::pi / 180.0;

/// What find_edges promises, one triangle after another.
std::vector<char> one_by_one(const std::vector<Facet>& f, const Links& links, double radius, double sharp_rad) {
  std::vector<char> edge(f.size(), 0);
  std::vector<std::size_t> seen_by(f.size(), f.size()), queue;
  for (std::size_t t = 0; t < f.size(); ++t) {
    queue.assign(1, t);
    seen_by[t] = t;
    for (std::size_t i = 0; i < queue.size() && queue.size() < kMostNeighbors; ++i)
      for (const int n : links[queue[i]]) {
        const auto other = static_cast<std::size_t>(n);
        if (n < 0 || seen_by[other] == t) continue;
        seen_by[other] = t;
        if ((f[other].center - f[t].center).squaredNorm() > radius * radius) continue;
        if (f[other].normal.dot(f[t].normal) < std::cos(sharp_rad)) edge[t] = 1;
        queue.push_back(other);
      }
  }
  return edge;
}

/// Returns how many triangles are edges.
long expect_same(TriangleMesh mesh, double radius, const char* what) {
  const Links links = link_triangles(mesh, std::numbers::pi).neighbors;
  const std::vector<Vec3> normals = triangle_normals(mesh);
  std::vector<Facet> facets;
  for (std::size_t t = 0; t < normals.size(); ++t) {
    Vec3 sum = Vec3::Zero();
    for (const int v : mesh.triangles[t]) sum += mesh.vertices[static_cast<std::size_t>(v)];
    facets.push_back({sum / 3.0, normals[t]});
  }
  const std::vector<char> edge = find_edges(facets, links, radius, kSharp);
  EXPECT_EQ(edge, one_by_one(facets, links, radius, kSharp)) << what << ", radius " << radius;
  return std::count(edge.begin(), edge.end(), 1);
}

/// Ground with waves of which some are too steep, and a step.
Vec3 waves(double u, double v) {
  const double steep = std::max(0.0, u - 0.3);
  return {100.0 * u, 100.0 * v, 12.0 * steep * std::sin(40.0 * v + 9.0 * u) + (v > 0.71 ? 4.0 : 0.0)};
}

TEST(ReadMeshEdges, FineMeshesHaveTheEdgesThatTheyHaveOneByOne) {
  // Fine enough, at the larger radii, for triangles that are looked at together; and several blocks.
  const int side = kSanitized ? 65 : 130;
  const TriangleMesh mesh = shapes::grid(side, side, waves);
  const auto all = static_cast<long>(mesh.triangles.size());
  for (const double radius : {0.1, 2.0, 9.0, 25.0, 1000.0}) {
    if (kSanitized && radius > 10.0) break;
    const long edges = expect_same(mesh, radius, "waves");
    EXPECT_LT(edges, all);
    EXPECT_EQ(edges > 0, radius > 0.2) << radius;
  }
}

TEST(ReadMeshEdges, NoiseAndStripsAndSmallPiecesToo) {
  const int share = kSanitized ? 2 : 1;  // each triangle is compared with every other
  TriangleMesh noisy = shapes::grid(80 / share, 80 / share, waves);
  shapes::shake(noisy, 0.12, 3);
  expect_same(noisy, 20.0, "noise");
  const auto turning = [](double u, double v) {
    return Vec3(3.0 * std::cos(9.0 * u), 3.0 * std::sin(9.0 * u), 40.0 * u + v);
  };
  expect_same(shapes::grid(3000 / share, 1, turning), 30.0, "strip");
  TriangleMesh holes = shapes::grid(90 / share, 90 / share, waves);
  shapes::cut(holes, [](const Vec3& x) { return std::fmod(x[0], 9.0) < 1.5 || std::fmod(x[1], 11.0) < 1.5; });
  expect_same(holes, 25.0, "small pieces");
  expect_same(shapes::sphere(10.0, 40), 9.0, "sphere");
}

}  // namespace
}  // namespace flank::internal
