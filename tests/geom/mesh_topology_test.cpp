#include "flank/geom/mesh_topology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flank/geom/mesh_repair.h"
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

// Also where vertices come apart first: at a fin, and at a bow tie.
TEST(MeshTopology, NeighboursAloneAreThoseOfLinkedTriangles) {
  TriangleMesh mesh = shapes::twisted(12);
  mesh.vertices.emplace_back(50.0, 50.0, 50.0);
  const int tip = static_cast<int>(mesh.vertices.size()) - 1;
  mesh.triangles.push_back({mesh.triangles[40][0], mesh.triangles[40][1], tip});
  mesh.vertices.emplace_back(-50.0, -50.0, 50.0);
  mesh.vertices.emplace_back(-50.0, -60.0, 50.0);
  mesh.triangles.push_back({mesh.triangles[0][0], tip + 1, tip + 2});
  for (const double crease : {0.1, 1.0, std::numbers::pi}) {
    TriangleMesh copy = mesh;
    EXPECT_EQ(linked_neighbors(mesh, mesh_edges(mesh), crease), link_triangles(copy, crease).neighbors) << crease;
    EXPECT_GT(copy.vertices.size(), mesh.vertices.size()) << crease;
  }
}

TEST(MeshTopology, VertexNormalsComeOneByOneToo) {
  TriangleMesh mesh = shapes::twisted(9);
  // The first triangle again, turned round: at its corners normals may cancel.
  mesh.triangles = {
      mesh.triangles[0], {mesh.triangles[0][0], mesh.triangles[0][2], mesh.triangles[0][1]}, mesh.triangles[99]};
  const std::vector<Vec3> all = vertex_normals(mesh);
  const MeshTopology fans = fans_of(mesh);
  for (int v = 0; v < static_cast<int>(all.size()); ++v) {
    EXPECT_EQ(vertex_normal(mesh, v, fans.around(v)), all[static_cast<std::size_t>(v)]);
    EXPECT_EQ(fans.around(v).empty(), all[static_cast<std::size_t>(v)].isZero());
  }
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

TEST(MeshTopology, CornerAnglesAreThoseOfTheTriangle) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {3, 0, 0}, {0, 4, 0}, {6, 0, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 1, 3}};
  EXPECT_NEAR(corner_angle(mesh, 0, 0), std::numbers::pi / 2, 1e-15);
  EXPECT_NEAR(corner_angle(mesh, 0, 1), std::atan2(4, 3), 1e-15);
  EXPECT_NEAR(corner_angle(mesh, 0, 2), std::atan2(3, 4), 1e-15);
  EXPECT_NEAR(corner_angle(mesh, 1, 1), std::numbers::pi, 1e-15) << "flat between its neighbours";
  Random random(1);
  for (int k = 0; k < 50; ++k) {
    for (Vec3& x : mesh.vertices) x = Vec3(random.normal(), random.normal(), random.normal());
    EXPECT_NEAR(corner_angle(mesh, 0, 0) + corner_angle(mesh, 0, 1) + corner_angle(mesh, 0, 2), std::numbers::pi,
                1e-12);
  }
}

/// Gauss and Bonnet: the turning of all rims and the bending of all inner vertices make up 2 pi times the Euler number.
TEST(MeshTopology, TurningAndBendingAddUpToTheEulerNumber) {
  const auto total = [](TriangleMesh mesh) {
    const MeshTopology topology = link_triangles(mesh, 3.0);
    double sum = 0.0;
    for (const auto& loop : border_loops(mesh, topology)) sum += total_turning(mesh, topology, loop);
    std::vector<double> angle(mesh.vertices.size(), 0.0);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (int k = 0; k < 3; ++k)
        angle[static_cast<std::size_t>(mesh.triangles[t][k])] += corner_angle(mesh, static_cast<int>(t), k);
    for (std::size_t v = 0; v < angle.size(); ++v)
      if (angle[v] > 0.0 && topology.on_border[v] == 0) sum += 2.0 * std::numbers::pi - angle[v];
    return sum / (2.0 * std::numbers::pi);
  };
  EXPECT_NEAR(total(shapes::torus(20, 8, 20, 15)), 0.0, 1e-9);
  EXPECT_NEAR(total(shapes::twisted(10)), 1.0, 1e-9) << "a disk";
  TriangleMesh ring = shapes::saddle(5.0, 20.0, 20);
  shapes::cut(ring, [](const Vec3& x) { return x.norm() < 2.0; });
  EXPECT_NEAR(total(ring), 0.0, 1e-9) << "a ring";
  TriangleMesh sieve = shapes::saddle(5.0, 20.0, 30);
  shapes::cut(sieve, [](const Vec3& x) { return (x - Vec3(2, 2, 0.2)).norm() < 1 || (x + Vec3(2, 2, 0)).norm() < 1; });
  EXPECT_NEAR(total(sieve), -1.0, 1e-9) << "a disk with two holes";
}

TEST(MeshTopology, CreasesAreWhereNormalsTurnByMore) {
  // A roof with 0.8 rad between its slopes.
  const auto roof = [] {
    return shapes::grid(
        2, 3, [](double u, double v) { return Vec3(4 * u - 2, 6 * v, -std::tan(0.4) * std::abs(4 * u - 2)); });
  };
  TriangleMesh joined = roof(), apart = roof();
  const MeshTopology smooth = link_triangles(joined, 0.9);
  EXPECT_EQ(joined.vertices.size(), 12u);
  EXPECT_EQ(border_loops(joined, smooth).size(), 1u);
  const MeshTopology creased = link_triangles(apart, 0.7);
  EXPECT_EQ(apart.vertices.size(), 16u) << "the ridge's vertices are doubled";
  EXPECT_EQ(border_loops(apart, creased).size(), 2u);
  const std::vector<int> number = components(creased);
  EXPECT_EQ(*std::max_element(number.begin(), number.end()), 1);
  const std::vector<Vec3> normals = vertex_normals(apart);
  for (std::size_t v = 0; v < apart.vertices.size(); ++v)
    EXPECT_NEAR(normals[v][2], std::cos(0.4), 1e-12) << "each side keeps its own normal";
}

TEST(MeshTopology, BorderLoopsRunWithTheSurfaceToTheirLeft) {
  TriangleMesh mesh = shapes::saddle(5.0, 1e9, 10);
  const MeshTopology topology = link_triangles(mesh, 0.9);
  const auto loops = border_loops(mesh, topology);
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_EQ(loops[0].size(), 40u);
  double doubled_area = 0.0;
  for (const TriangleSide& s : loops[0]) {
    const auto& t = mesh.triangles[static_cast<std::size_t>(s.triangle)];
    const Vec3 &a = mesh.vertices[static_cast<std::size_t>(t[(s.side + 1) % 3])],
               &b = mesh.vertices[static_cast<std::size_t>(t[(s.side + 2) % 3])];
    doubled_area += a[0] * b[1] - b[0] * a[1];
  }
  EXPECT_NEAR(doubled_area, 2.0 * 100.0, 1e-9) << "counter-clockwise";
}

TEST(MeshTopology, VertexNormalsDoNotDependOnHowTheAreaIsDivided) {
  // A cube's corner: the diagonals of its faces must not count.
  TriangleMesh cube = shapes::sphere(std::sqrt(3.0), 1);
  const std::vector<Vec3> normals = vertex_normals(repair_mesh(cube).mesh);
  ASSERT_EQ(normals.size(), 8u);
  const TriangleMesh welded = repair_mesh(cube).mesh;
  for (std::size_t v = 0; v < normals.size(); ++v)
    EXPECT_LT((normals[v] - welded.vertices[v].normalized()).norm(), 1e-12);
  TriangleMesh flat;
  flat.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}};
  flat.triangles = {{0, 1, 2}, {0, 1, 3}};
  EXPECT_EQ(triangle_normals(flat)[0], Vec3(0, 0, 0)) << "no area, no normal";
  EXPECT_EQ(vertex_normals(flat)[3], Vec3(0, 0, 1));
}

TEST(MeshEdges, HoldTheSidesOfEachEdgeTogetherInTheirOrder) {
  TriangleMesh mesh;
  mesh.vertices.assign(5, Vec3::Zero());
  // Edge 1-2 has three triangles, 0-1 and 2-4 have one.
  mesh.triangles = {{3, 2, 1}, {0, 1, 2}, {2, 1, 4}};
  std::vector<std::vector<int>> found;
  for_each_edge(mesh_edges(mesh), [&](std::span<const EdgeUse> uses) {
    found.push_back({uses[0].low, uses[0].high});
    for (const EdgeUse& use : uses) {
      const auto& t = mesh.triangles[static_cast<std::size_t>(use.triangle)];
      const int a = t[static_cast<std::size_t>((use.side + 1) % 3)],
                b = t[static_cast<std::size_t>((use.side + 2) % 3)];
      EXPECT_EQ(a, use.ascending ? use.low : use.high);
      EXPECT_EQ(b, use.ascending ? use.high : use.low);
      found.back().push_back(use.triangle);
    }
  });
  const std::vector<std::vector<int>> expected = {{0, 1, 1}, {0, 2, 1}, {1, 2, 0, 1, 2}, {1, 3, 0},
                                                  {1, 4, 2}, {2, 3, 0}, {2, 4, 2}};
  EXPECT_EQ(found, expected);
}

}  // namespace
}  // namespace flank::internal
