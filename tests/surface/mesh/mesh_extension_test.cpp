// The continuation of a mesh past its borders: exact for planes, close for quadrics, smooth at the join, no farther
// than asked for.
#include "flank/surface/mesh/mesh_extension.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "surface/jet_surfaces.h"

namespace flank::internal {
namespace {

JetSurface extended(TriangleMesh mesh, const ExtensionOptions& options = {}) {
  JetSurface s = shapes::jet_surface(std::move(mesh));
  extend(s, vertex_normals(s.mesh), options);
  return s;
}

int added(const JetSurface& s) { return static_cast<int>(s.mesh.triangles.size()) - s.real_triangles; }

/// Largest value of a measure over the appended triangles.
template <class Measure>
double largest(const JetSurface& s, const Measure& measure) {
  double worst = 0.0;
  for (int t = s.real_triangles; t < static_cast<int>(s.mesh.triangles.size()); ++t)
    for (const auto& [u, v] : {std::pair(0.0, 0.0), std::pair(1.0, 0.0), std::pair(0.3, 0.3)})
      worst = std::max(worst, measure(s.jet(t, u, v).p));
  return worst;
}

TEST(MeshExtension, GoesATenthOfTheWayPastAPlanesBorder) {
  const JetSurface s = extended(shapes::sheet(30, 20, 30, 20));
  EXPECT_GT(added(s), 0);
  EXPECT_EQ(s.jets.size(), s.mesh.vertices.size());
  EXPECT_EQ(s.topology.neighbors.size(), s.mesh.triangles.size());
  EXPECT_LT(largest(s, [](const Vec3& p) { return std::abs(p[2]); }), 1e-10) << "it stays in the plane";
  Box3 box;
  for (const Vec3& x : s.mesh.vertices) box.add(x);
  // A tenth of the mesh's extent behind each border; rounded off at the corners.
  EXPECT_NEAR(box.high[0], 33.0, 0.4);
  EXPECT_NEAR(box.low[0], -3.0, 0.4);
  EXPECT_NEAR(box.high[1], 22.0, 0.7);
  EXPECT_NEAR(box.low[1], -2.0, 0.7);
}

TEST(MeshExtension, LengthIsWhatIsAskedFor) {
  for (const double share : {0.05, 0.2}) {
    const JetSurface s = extended(shapes::sheet(20, 20, 20, 20), {share, 0.18});
    Box3 box;
    for (const Vec3& x : s.mesh.vertices) box.add(x);
    EXPECT_NEAR(box.high[0], 20.0 * (1.0 + share), 0.1 * 20.0 * share + 0.1) << share;
  }
  EXPECT_EQ(added(extended(shapes::sheet(20, 20, 20, 20), {0.0, 0.18})), 0);
}

TEST(MeshExtension, LeavesTheRealMeshAsItIs) {
  const JetSurface bare = shapes::jet_surface(shapes::twisted(20)), wide = extended(shapes::twisted(20));
  EXPECT_EQ(wide.real_triangles, bare.real_triangles);
  for (std::size_t t = 0; t < bare.mesh.triangles.size(); ++t)
    EXPECT_EQ(wide.mesh.triangles[t], bare.mesh.triangles[t]);
  for (std::size_t v = 0; v < bare.mesh.vertices.size(); ++v) {
    EXPECT_EQ(wide.mesh.vertices[v], bare.mesh.vertices[v]);
    EXPECT_EQ(wide.jets[v].c, bare.jets[v].c);
  }
}

/// Neighbours agree with each other, and each border side of the real mesh leads on.
TEST(MeshExtension, IsLinkedToTheMeshAllRound) {
  const JetSurface s = extended(shapes::sheet(20, 20, 12, 12));
  for (int t = 0; t < static_cast<int>(s.mesh.triangles.size()); ++t)
    for (int side = 0; side < 3; ++side) {
      const int other = s.neighbor(t, side);
      if (t < s.real_triangles) {
        EXPECT_GE(other, 0);
      }
      if (other < 0) continue;
      bool back = false;
      for (int k = 0; k < 3; ++k) back = back || s.neighbor(other, k) == t;
      EXPECT_TRUE(back);
      const auto& a = s.mesh.triangles[static_cast<std::size_t>(t)];
      const auto& b = s.mesh.triangles[static_cast<std::size_t>(other)];
      const std::set<int> theirs(b.begin(), b.end());
      EXPECT_TRUE(theirs.contains(a[(side + 1) % 3]) && theirs.contains(a[(side + 2) % 3]));
    }
}

TEST(MeshExtension, KeepsTheOrientation) {
  const JetSurface s = extended(shapes::sheet(20, 20, 12, 12));
  for (int t = s.real_triangles; t < static_cast<int>(s.mesh.triangles.size()); ++t) {
    const Vec3 n = (s.corner(t, 1) - s.corner(t, 0)).cross(s.corner(t, 2) - s.corner(t, 0));
    EXPECT_GT(n[2], 0.0);
  }
}

TEST(MeshExtension, FollowsASphereAndACylinder) {
  TriangleMesh cap = shapes::sphere(20, 30);
  shapes::cut(cap, [](const Vec3& x) { return x[2] < 12.0; });
  const JetSurface ball = extended(cap);
  EXPECT_GT(added(ball), 0);
  const double reach = largest(ball, [](const Vec3& p) { return 12.0 - p[2]; });
  EXPECT_GT(reach, 1.0) << "it goes down on the far side of the rim";
  EXPECT_LT(largest(ball, [](const Vec3& p) { return std::abs(p.norm() - 20.0); }), 0.05);
  const JetSurface arc = extended(shapes::grid(
      40, 30, [](double u, double v) { return Vec3(15 * std::cos(1.5 * u), 15 * std::sin(1.5 * u), 20 * v); }));
  EXPECT_LT(largest(arc, [](const Vec3& p) { return std::abs(p.head<2>().norm() - 15.0); }), 0.02);
  EXPECT_GT(largest(arc, [](const Vec3& p) { return -std::atan2(p[1], p[0]); }), 0.1) << "round the axis";
}

TEST(MeshExtension, JoinsWithoutAGapOrAKink) {
  const JetSurface s = extended(shapes::twisted(60));
  double gap = 0.0, kink = 0.0;
  int joins = 0;
  for (int t = 0; t < s.real_triangles; ++t)
    for (int side = 0; side < 3; ++side) {
      const int other = s.neighbor(t, side);
      if (other < s.real_triangles) continue;
      const auto& a = s.mesh.triangles[static_cast<std::size_t>(t)];
      const auto& b = s.mesh.triangles[static_cast<std::size_t>(other)];
      std::array<double, 3> here{}, there{};
      here[static_cast<std::size_t>((side + 1) % 3)] = 0.4;
      here[static_cast<std::size_t>((side + 2) % 3)] = 0.6;
      for (std::size_t k = 0; k < 3; ++k)
        there[k] = b[k] == a[static_cast<std::size_t>((side + 1) % 3)]   ? 0.4
                   : b[k] == a[static_cast<std::size_t>((side + 2) % 3)] ? 0.6
                                                                         : 0.0;
      const SurfaceJet x = s.jet(t, here[1], here[2]), y = s.jet(other, there[1], there[2]);
      gap = std::max(gap, (x.p - y.p).norm());
      kink = std::max(kink, (x.du.cross(x.dv).normalized() - y.du.cross(y.dv).normalized()).norm());
      ++joins;
    }
  EXPECT_EQ(joins, 4 * 60);
  EXPECT_LT(gap, 1e-12);
  EXPECT_LT(kink, 1e-4);
}

TEST(MeshExtension, CoversAHole) {
  TriangleMesh mesh = shapes::sheet(20, 20, 40, 40);
  shapes::cut(mesh, [](const Vec3& x) { return (x - Vec3(10, 10, 0)).norm() < 4.0; });
  const JetSurface s = extended(repair_mesh(mesh).mesh);
  EXPECT_LT(largest(s, [](const Vec3& p) { return std::abs(p[2]); }), 1e-10);
  double inside = 0.0;
  for (int t = s.real_triangles; t < static_cast<int>(s.mesh.triangles.size()); ++t) {
    const Vec3 a = s.corner(t, 0), n = (s.corner(t, 1) - a).cross(s.corner(t, 2) - a);
    EXPECT_GT(n[2], 0.0);
    const Vec3 middle = (a + s.corner(t, 1) + s.corner(t, 2)) / 3.0;
    if (middle[0] > 0 && middle[0] < 20 && middle[1] > 0 && middle[1] < 20) inside += 0.5 * n.norm();
  }
  double real = 0.0;
  for (int t = 0; t < s.real_triangles; ++t) real += s.area(t);
  EXPECT_NEAR(inside + real, 400.0, 1e-6) << "once, without a gap and without an overlap";
}

TEST(MeshExtension, ClosedMeshesHaveNone) {
  EXPECT_EQ(added(extended(shapes::sphere(10, 8))), 0);
  EXPECT_EQ(added(extended(shapes::torus(20, 8, 30, 20))), 0);
}

}  // namespace
}  // namespace flank::internal
