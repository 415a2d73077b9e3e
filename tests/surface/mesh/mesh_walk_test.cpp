// Walks to footpoints on meshes: closed forms, far starts, borders and how far a walk may reach.
#include "flank/surface/mesh/mesh_walk.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "flank/surface/mesh/mesh_extension.h"
#include "surface/jet_surfaces.h"

namespace flank::internal {
namespace {

MeshPlace middle_of(int triangle) { return {triangle, 1.0 / 3.0, 1.0 / 3.0}; }

Footpoint foot(const JetSurface& s, const Vec3& p, int start, Reach reach = Reach::kReal) {
  const MeshWalk walk = walk_to_footpoint(s, p, middle_of(start), reach);
  EXPECT_TRUE(walk.converged) << p.transpose();
  return footpoint_of(walk, p, s.real_triangles);
}

TEST(MeshWalk, CrossesAPlaneFromAnywhereToItsFootpoint) {
  const JetSurface s = shapes::jet_surface(shapes::sheet(20, 12, 25, 18));
  Random random(1);
  for (int k = 0; k < 200; ++k) {
    const Vec3 p(random.uniform(0, 20), random.uniform(0, 12), random.uniform(-5, 5));
    const Footpoint f = foot(s, p, static_cast<int>(random.next() % s.mesh.triangles.size()));
    EXPECT_EQ(f.location, Location::kInside);
    EXPECT_LT((f.point - Vec3(p[0], p[1], 0)).norm(), 1e-10);
    EXPECT_NEAR(f.distance, p[2], 1e-10) << "signed";
    EXPECT_LT((f.normal - Vec3::UnitZ()).norm(), 1e-10);
    EXPECT_NEAR(f.k1, 0.0, 1e-9);
    EXPECT_NEAR(f.k2, 0.0, 1e-9);
    EXPECT_GE(std::min({f.u, f.v, 1.0 - f.u - f.v}), -1e-4) << "in the triangle that it names";
    const SurfaceJet jet = s.jet(f.patch, f.u, f.v);
    EXPECT_LT((jet.p - f.point).norm(), 1e-10);
  }
}

TEST(MeshWalk, EndsAtTheBorderWhereThePlaneEnds) {
  const JetSurface s = shapes::jet_surface(shapes::sheet(20, 12, 25, 18));
  Random random(2);
  int held = 0;
  for (int k = 0; k < 200; ++k) {
    const Vec3 p(random.uniform(-10, 30), random.uniform(-10, 22), random.uniform(-5, 5));
    const Vec3 q(std::clamp(p[0], 0.0, 20.0), std::clamp(p[1], 0.0, 12.0), 0.0);
    if ((q - p).head<2>().norm() < 1e-3) continue;
    ++held;
    const Footpoint f = foot(s, p, static_cast<int>(random.next() % s.mesh.triangles.size()));
    EXPECT_EQ(f.location, Location::kBorder) << p.transpose();
    EXPECT_LT((f.point - q).norm(), 1e-8) << p.transpose();
    EXPECT_NEAR(std::abs(f.distance), (p - q).norm(), 1e-8);
    EXPECT_EQ(f.distance < 0.0, p[2] < 0.0) << "the side of the surface decides the sign";
  }
  EXPECT_GT(held, 100);
}

TEST(MeshWalk, HasTheCurvaturesOfASphereFromBothSides) {
  const JetSurface s = shapes::jet_surface(shapes::sphere(10, 20));
  Random random(3);
  for (int k = 0; k < 40; ++k) {
    const Vec3 direction = Vec3(random.normal(), random.normal(), random.normal()).normalized();
    for (const double radius : {6.0, 10.0, 17.0}) {
      // Start on the same side of the sphere: a walk finds the local minimum.
      int start = 0;
      for (int t = 0; t < s.real_triangles; ++t)
        if (s.corner(t, 0).dot(direction) > s.corner(start, 0).dot(direction)) start = t;
      const Footpoint f = foot(s, radius * direction, start);
      EXPECT_NEAR(f.distance, radius - 10.0, 1e-5);
      EXPECT_NEAR(f.k1, -0.1, 2e-3) << "it bends away from the machining side";
      EXPECT_NEAR(f.k2, -0.1, 2e-3);
      EXPECT_LE(f.k1, f.k2);
      EXPECT_LT((f.normal - direction).norm(), 1e-3);
    }
  }
}

TEST(MeshWalk, PrincipalDirectionsOfACylinderAreItsAxisAndItsCircles) {
  const JetSurface s = shapes::jet_surface(
      shapes::grid(60, 30, [](double u, double v) { return Vec3(5 * std::cos(2 * u), 5 * std::sin(2 * u), 10 * v); }));
  Random random(4);
  for (int k = 0; k < 60; ++k) {
    const double angle = random.uniform(0.3, 1.7), z = random.uniform(2, 8), radius = random.uniform(4, 9);
    const Vec3 out(std::cos(angle), std::sin(angle), 0);
    const Vec3 p = radius * out + z * Vec3::UnitZ();
    const Footpoint f = foot(s, p, s.real_triangles / 2);
    EXPECT_NEAR(f.k1, -0.2, 1e-4);
    EXPECT_NEAR(f.k2, 0.0, 1e-4);
    EXPECT_NEAR(std::abs(f.d2[2]), 1.0, 1e-6) << "straight along the axis";
    EXPECT_NEAR(f.d1[2], 0.0, 1e-3);
    EXPECT_LT((f.d1.cross(f.d2) - f.normal).norm(), 1e-9) << "a right-handed frame";
    EXPECT_NEAR(f.distance, radius - 5.0, 1e-6);
  }
}

TEST(MeshWalk, FindsWhatDenseSearchFinds) {
  const JetSurface s = shapes::jet_surface(shapes::twisted(24));
  Random random(5);
  for (int k = 0; k < 12; ++k) {
    const double u = random.uniform(0.1, 0.9), v = random.uniform(0.1, 0.9);
    const Vec3 p = shapes::twisted_point(u, v) + 2.0 * Vec3(random.normal(), random.normal(), random.normal());
    double least = 1e300;
    int start = 0;
    for (int t = 0; t < s.real_triangles; ++t)
      for (int i = 0; i <= 6; ++i)
        for (int j = 0; i + j <= 6; ++j) {
          const double d = (s.jet(t, i / 6.0, j / 6.0).p - p).norm();
          if (d < least) least = d, start = t;
        }
    const double found = std::abs(foot(s, p, start).distance);
    EXPECT_LE(found, least + 1e-12);
    EXPECT_GT(found, least - 0.2) << "a grid point lies within a third of a millimetre of the footpoint";
  }
}

TEST(MeshWalk, TheFootpointOfTheFootpointIsItself) {
  const JetSurface s = shapes::jet_surface(shapes::twisted(24));
  for (int t = 3; t < s.real_triangles; t += 97) {
    const SurfaceJet jet = s.jet(t, 0.2, 0.5);
    const Footpoint f = foot(s, jet.p, t);
    EXPECT_LT((f.point - jet.p).norm(), 1e-12);
    EXPECT_NEAR(f.distance, 0.0, 1e-12);
    const Vec3 normal = jet.du.cross(jet.dv).normalized();
    const Footpoint above = foot(s, jet.p + 0.5 * normal, t);
    EXPECT_LT((above.point - jet.p).norm(), 1e-9) << "and of a point on its normal";
    EXPECT_NEAR(above.distance, 0.5, 1e-11);
  }
}

TEST(MeshWalk, ReachSaysWhetherTheExtensionCounts) {
  JetSurface s = shapes::jet_surface(shapes::sheet(20, 12, 25, 18));
  extend(s, vertex_normals(s.mesh), {});
  ASSERT_GT(static_cast<int>(s.mesh.triangles.size()), s.real_triangles);
  const Vec3 p(21.0, 6.0, 2.0);
  const Footpoint real = foot(s, p, 0, Reach::kReal), extended = foot(s, p, 0, Reach::kExtended);
  EXPECT_EQ(real.location, Location::kBorder);
  EXPECT_LT((real.point - Vec3(20, 6, 0)).norm(), 1e-8);
  EXPECT_LT(real.patch, s.real_triangles);
  EXPECT_EQ(extended.location, Location::kExtension);
  EXPECT_GE(extended.patch, s.real_triangles);
  EXPECT_LT((extended.point - Vec3(21, 6, 0)).norm(), 1e-8);
  EXPECT_NEAR(extended.distance, 2.0, 1e-9);
}

TEST(MeshWalk, OneTriangleHoldsAllThatLiesBesideIt) {
  TriangleMesh one;
  one.vertices = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  one.triangles = {{0, 1, 2}};
  const JetSurface s = shapes::jet_surface(one);
  EXPECT_LT((foot(s, Vec3(1, 1, 3), 0).point - Vec3(1, 1, 0)).norm(), 1e-12);
  EXPECT_LT((foot(s, Vec3(1, -3, 1), 0).point - Vec3(1, 0, 0)).norm(), 1e-12);
  EXPECT_LT((foot(s, Vec3(4, 4, 1), 0).point - Vec3(2, 2, 0)).norm(), 1e-12);
  EXPECT_LT((foot(s, Vec3(9, -1, 1), 0).point - Vec3(4, 0, 0)).norm(), 1e-12);
}

}  // namespace
}  // namespace flank::internal
