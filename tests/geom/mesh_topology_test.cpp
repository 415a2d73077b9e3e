#include "flank/geom/mesh_topology.h"

#include <gtest/gtest.h>

#include <numbers>

#include "surface/mesh_shapes.h"

namespace flank::internal {
namespace {

TEST(MeshTopology, NeighboursAreMutual) {
  TriangleMesh mesh = shapes::twisted(12);
  const MeshTopology topology = link_triangles(mesh, 1.0);
  int open = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const int other = topology.neighbors[t][k];
      if (other < 0) {
        ++open;
        continue;
      }
      const auto& back = topology.neighbors[static_cast<std::size_t>(other)];
      EXPECT_EQ(std::count(back.begin(), back.end(), static_cast<int>(t)), 1);
    }
  }
  EXPECT_EQ(open, 4 * 12);
}

TEST(MeshTopology, TurningTellsRimTubeAndHoleApart) {
  TriangleMesh disk = shapes::saddle(5.0, 1e9, 20);
  shapes::cut(disk, [](const Vec3& x) { return std::hypot(x[0], x[1]) < 2.0; });
  const MeshTopology topology = link_triangles(disk, 1.0);
  std::vector<double> turning;
  for (const auto& loop : border_loops(disk, topology)) turning.push_back(total_turning(disk, topology, loop));
  ASSERT_EQ(turning.size(), 2u);
  EXPECT_NEAR(turning[0], 2.0 * std::numbers::pi, 1e-9);
  EXPECT_NEAR(turning[1], -2.0 * std::numbers::pi, 1e-9);

  TriangleMesh tube = shapes::grid(
      24, 5,
      [](double u, double v) {
        const double a = 2.0 * std::numbers::pi * u;
        return Vec3(std::cos(a), std::sin(a), v);
      },
      true, false);
  const MeshTopology tube_topology = link_triangles(tube, 1.0);
  const auto loops = border_loops(tube, tube_topology);
  ASSERT_EQ(loops.size(), 2u);
  for (const auto& loop : loops) EXPECT_NEAR(total_turning(tube, tube_topology, loop), 0.0, 1e-9);
}

TEST(MeshTopology, CreasesComeApart) {
  // A roof of two planes at right angles: linked across the ridge only if the crease angle allows it.
  const auto roof = [](double u, double v) { return Vec3(2.0 * u - 1.0, 4.0 * v, 1.0 - std::abs(2.0 * u - 1.0)); };
  TriangleMesh sharp = shapes::grid(6, 4, roof), soft = sharp;
  const MeshTopology cut = link_triangles(sharp, 1.0), whole = link_triangles(soft, 2.0);
  EXPECT_EQ(border_loops(sharp, cut).size(), 2u);
  EXPECT_EQ(sharp.vertices.size(), soft.vertices.size() + 5);
  EXPECT_EQ(border_loops(soft, whole).size(), 1u);
  const auto number = components(cut);
  EXPECT_EQ(*std::max_element(number.begin(), number.end()), 1);
}

TEST(MeshTopology, FinComesOffAndTheSurfaceCloses) {
  TriangleMesh mesh = shapes::saddle(5.0, 1e9, 6);
  const std::size_t triangles = mesh.triangles.size();
  const auto side = mesh.triangles[20];
  mesh.vertices.emplace_back(0.0, 0.0, 3.0);
  mesh.triangles.push_back({side[0], side[1], static_cast<int>(mesh.vertices.size()) - 1});
  const MeshTopology topology = link_triangles(mesh, 1.0);
  EXPECT_EQ(border_loops(mesh, topology).size(), 2u);  // the rim, and the fin on its own
  EXPECT_EQ(topology.neighbors[triangles], (std::array<int, 3>{-1, -1, -1}));
}

}  // namespace
}  // namespace flank::internal
