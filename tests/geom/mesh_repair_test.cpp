#include "flank/geom/mesh_repair.h"

#include <gtest/gtest.h>

#include "flank/base/random.h"
#include "flank/error.h"
#include "flank/geom/mesh_topology.h"
#include "surface/mesh_shapes.h"

namespace flank::internal {
namespace {

double area(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles) {
    const Vec3& a = mesh.vertices[static_cast<std::size_t>(t[0])];
    sum += 0.5 * (mesh.vertices[static_cast<std::size_t>(t[1])] - a)
                     .cross(mesh.vertices[static_cast<std::size_t>(t[2])] - a)
                     .norm();
  }
  return sum;
}

TEST(MeshRepair, SoundMeshKeepsItsNumbers) {
  const TriangleMesh mesh = shapes::twisted(9);
  const RepairedMesh repaired = repair_mesh(mesh);
  EXPECT_TRUE(repaired.repair.clean());
  EXPECT_EQ(repaired.repair.account(), "nothing");
  EXPECT_EQ(repaired.mesh.triangles, mesh.triangles);
  EXPECT_EQ(repaired.mesh.vertices, mesh.vertices);
}

TEST(MeshRepair, WeldsASoup) {
  const TriangleMesh mesh = shapes::twisted(9);
  TriangleMesh soup;
  for (const auto& t : mesh.triangles) {
    for (int v : t) soup.vertices.push_back(mesh.vertices[static_cast<std::size_t>(v)]);
    const int n = static_cast<int>(soup.vertices.size());
    soup.triangles.push_back({n - 3, n - 2, n - 1});
  }
  const RepairedMesh exact = repair_mesh(soup);
  EXPECT_EQ(exact.mesh.vertices.size(), mesh.vertices.size());
  EXPECT_EQ(exact.repair.welded_vertices, static_cast<int>(soup.vertices.size() - mesh.vertices.size()));
  EXPECT_EQ(exact.repair.isolated_vertices, 0);
  shapes::shake(soup, 1e-9, 1);
  EXPECT_EQ(repair_mesh(soup).mesh.vertices.size(), soup.vertices.size());
  EXPECT_EQ(repair_mesh(soup, 1e-8).mesh.vertices.size(), mesh.vertices.size());
}

TEST(MeshRepair, VerticesFarAwayMakeNoTriangleSmall) {
  const TriangleMesh mesh = shapes::twisted(9);
  const double far = 1e7 * mesh.box().diagonal();
  TriangleMesh unused = mesh, used = mesh;
  unused.vertices.emplace_back(far, 0, 0);
  used.vertices.emplace_back(far, 0, 0);
  const int a = used.triangles[0][0], b = used.triangles[0][1];
  used.triangles.push_back({b, a, static_cast<int>(used.vertices.size()) - 1});
  for (const TriangleMesh& strange : {unused, used}) {
    const RepairedMesh repaired = repair_mesh(strange, 1e-7);
    EXPECT_EQ(repaired.repair.welded_vertices, 0);
    EXPECT_EQ(repaired.repair.degenerate_triangles, 0);
    EXPECT_EQ(repaired.mesh.triangles.size(), strange.triangles.size());
  }
}

TEST(MeshRepair, RemovesWhatIsNoSurface) {
  TriangleMesh mesh = shapes::twisted(6);
  const double before = area(mesh);
  mesh.vertices.emplace_back(100.0, 0.0, 0.0);                                                   // isolated
  mesh.triangles.push_back({3, 3, 4});                                                           // a corner twice
  mesh.triangles.push_back({mesh.triangles[5][1], mesh.triangles[5][2], mesh.triangles[5][0]});  // again
  const RepairedMesh repaired = repair_mesh(mesh);
  EXPECT_EQ(repaired.repair.isolated_vertices, 1);
  EXPECT_EQ(repaired.repair.degenerate_triangles, 1);
  EXPECT_EQ(repaired.repair.duplicate_triangles, 1);
  EXPECT_NEAR(area(repaired.mesh), before, 1e-12 * before);
}

TEST(MeshRepair, MendsAZeroAreaTriangleWithoutACrack) {
  // A square of two triangles; a zero-area one (0, 4, 2) splits its diagonal side of the first triangle only.
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0}};
  mesh.triangles = {{0, 1, 4}, {1, 2, 4}, {0, 2, 3}, {0, 4, 2}};
  RepairedMesh repaired = repair_mesh(mesh);
  EXPECT_EQ(repaired.repair.swapped_diagonals, 1);
  EXPECT_NEAR(area(repaired.mesh), 1.0, 1e-15);
  const MeshTopology topology = link_triangles(repaired.mesh, 1.0);
  const auto loops = border_loops(repaired.mesh, topology);
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_EQ(loops[0].size(), 4u);
}

TEST(MeshRepair, TurnsTheFewToTheMany) {
  const TriangleMesh mesh = shapes::twisted(8);
  TriangleMesh mixed = mesh;
  for (std::size_t t : {3u, 40u, 41u, 77u}) std::swap(mixed.triangles[t][1], mixed.triangles[t][2]);
  const RepairedMesh repaired = repair_mesh(mixed);
  EXPECT_EQ(repaired.repair.flipped_triangles, 4);
  EXPECT_EQ(repaired.mesh.triangles, mesh.triangles);
  EXPECT_EQ(repaired.repair.account(), "flipped 4 triangles");
}

TEST(MeshRepair, RefusesWhatCannotBeMended) {
  EXPECT_THROW((void)repair_mesh({}), InputError);
  TriangleMesh mesh = shapes::twisted(3);
  mesh.triangles[0][1] = 99;
  EXPECT_THROW((void)repair_mesh(mesh), InputError);
  mesh = shapes::twisted(3);
  mesh.vertices[2][1] = std::nan("");
  EXPECT_THROW((void)repair_mesh(mesh), InputError);
  mesh.vertices.assign(3, Vec3::Zero());
  mesh.triangles = {{0, 1, 2}};
  EXPECT_THROW((void)repair_mesh(mesh), InputError);
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  EXPECT_THROW((void)repair_mesh(mesh), InputError);
}

TEST(MeshRepair, RefusesAMoebiusStrip) {
  TriangleMesh strip;
  const int n = 40;
  for (int i = 0; i < n; ++i) {
    const double a = 2.0 * std::numbers::pi * i / n;
    for (double w : {-1.0, 1.0})
      strip.vertices.emplace_back((5.0 + w * std::cos(0.5 * a)) * std::cos(a),
                                  (5.0 + w * std::cos(0.5 * a)) * std::sin(a), w * std::sin(0.5 * a));
  }
  for (int i = 0; i < n; ++i) {
    const bool last = i + 1 == n;
    const int a = 2 * i, b = a + 1, c = last ? 1 : a + 2, d = last ? 0 : a + 3;
    strip.triangles.push_back({a, c, b});
    strip.triangles.push_back({b, c, d});
  }
  EXPECT_THROW((void)repair_mesh(strip), InputError);
}

// Whichever cells of a grid they fall into.
TEST(MeshRepair, VerticesWithinTheToleranceAreOneWhereverTheyLie) {
  Random random(11);
  constexpr double kShare = 1e-3;
  TriangleMesh mesh;
  // The box, and so the tolerance, is that of these.
  mesh.vertices = {Vec3(0, 0, 0), Vec3(100, 0, 0), Vec3(100, 100, 100)};
  mesh.triangles = {{0, 1, 2}};
  const double tolerance = kShare * mesh.box().diagonal();
  int near = 0;
  for (int i = 0; i < 400; ++i) {
    const Vec3 at(5.0 + 4.0 * (i % 20) + random.uniform(0.0, 1.0), 10.0 + 4.0 * (i / 20) + random.uniform(0.0, 1.0),
                  random.uniform(10.0, 90.0));
    const Vec3 way = Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)).normalized();
    const bool within = i % 2 == 0;
    near += within ? 1 : 0;
    const int k = static_cast<int>(mesh.vertices.size());
    for (const Vec3& p :
         {at, Vec3(at + Vec3(0, 0, 1)), Vec3(at + Vec3(1, 0, 0)), Vec3(at + (within ? 0.999 : 1.001) * tolerance * way),
          Vec3(at + Vec3(0, 0, -1)), Vec3(at + Vec3(0, 1, 0))})
      mesh.vertices.push_back(p);
    mesh.triangles.push_back({k, k + 1, k + 2});
    mesh.triangles.push_back({k + 3, k + 4, k + 5});
  }
  EXPECT_EQ(repair_mesh(mesh, kShare).repair.welded_vertices, near);
}

}  // namespace
}  // namespace flank::internal
