#include "flank/geom/tessellate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flank/error.h"
#include "flank/geom/trim.h"

namespace flank::internal {
namespace {

/// The quarter of a cylinder of radius 10 and height 20, exact; u around, v along z. The outward normal is the radial one.
Face quarter_cylinder() {
  Face face;
  BSplineSurface& s = face.surface;
  s.degree_u = 2;
  s.degree_v = 1;
  s.knots_u = {0, 0, 0, 1, 1, 1};
  s.knots_v = {0, 0, 1, 1};
  s.count_u = 3;
  s.count_v = 2;
  const double w = std::numbers::sqrt2 / 2;
  s.poles = {{10, 0, 0}, {10, 0, 20}, {10, 10, 0}, {10, 10, 20}, {0, 10, 0}, {0, 10, 20}};
  s.weights = {1, 1, w, w, 1, 1};
  return face;
}

TrimLoop circle(double u, double v, double radius) {
  TrimLoop loop;
  BSplineCurve2 edge;
  edge.degree = 1;
  constexpr int kSides = 128;
  edge.poles.resize(2, kSides + 1);
  edge.knots.push_back(0);
  for (int k = 0; k <= kSides; ++k) {
    const double angle = 2 * std::numbers::pi * k / kSides;
    edge.poles.col(k) = Vec2(u + radius * std::cos(angle), v + radius * std::sin(angle));
    edge.knots.push_back(k);
  }
  edge.knots.push_back(kSides);
  loop.edges.push_back(edge);
  return loop;
}

double area(const TriangleMesh& mesh) {
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles)
    sum += 0.5 * (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]).norm();
  return sum;
}

TEST(Tessellate, StaysWithinTheChord) {
  for (const double chord : {0.5, 0.05, 0.005}) {
    const TriangleMesh mesh = tessellate(quarter_cylinder(), {.chord_mm = chord}).mesh;
    ASSERT_FALSE(mesh.triangles.empty());
    for (const auto& [a, b, c] : mesh.triangles) {
      const Vec3 middle = (mesh.vertices[a] + mesh.vertices[b] + mesh.vertices[c]) / 3;
      EXPECT_NEAR(middle.head<2>().norm(), 10.0, chord);
      const Vec3 normal = (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]);
      EXPECT_GT(normal.head<2>().dot(middle.head<2>()), 0.0) << "turned inside out";
    }
    EXPECT_NEAR(area(mesh), 0.5 * std::numbers::pi * 10 * 20, 40 * chord);
  }
}

TEST(Tessellate, SaysTheParametersOfItsVertices) {
  Face face = quarter_cylinder();
  face.loops.push_back(circle(0.5, 0.5, 0.3));
  const Tessellation t = tessellate(face, {.chord_mm = 0.01});
  ASSERT_EQ(t.parameters.size(), t.mesh.vertices.size());
  for (std::size_t k = 0; k < t.parameters.size(); ++k)
    EXPECT_EQ(t.mesh.vertices[k], face.surface.value(t.parameters[k].x(), t.parameters[k].y()));
}

TEST(Tessellate, KeepsTheEdgeLength) {
  const TriangleMesh mesh = tessellate(quarter_cylinder(), {.chord_mm = 1.0, .edge_mm = 0.5}).mesh;
  double longest = 0;
  for (const auto& t : mesh.triangles)
    for (int k = 0; k < 3; ++k)
      longest = std::max(longest, (mesh.vertices[t[k]] - mesh.vertices[t[(k + 1) % 3]]).norm());
  EXPECT_LT(longest, std::numbers::sqrt2 * 0.55);
}

TEST(Tessellate, AReversedFaceIsSeenFromTheOtherSide) {
  Face face = quarter_cylinder();
  face.reversed = true;
  const TriangleMesh mesh = tessellate(face, {.chord_mm = 0.1}).mesh;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 normal = (mesh.vertices[b] - mesh.vertices[a]).cross(mesh.vertices[c] - mesh.vertices[a]);
    EXPECT_LT(normal.head<2>().dot(mesh.vertices[a].head<2>()), 0.0);
  }
}

TEST(Tessellate, CutsAlongTrims) {
  Face face = quarter_cylinder();
  face.loops = {rectangle_loop({0, 1, 0, 1}), circle(0.5, 0.5, 0.25)};
  const Tessellation pieces = tessellate(face, {.chord_mm = 0.05, .edge_mm = 0.5});
  ASSERT_EQ(pieces.borders.size(), 2u);
  const TrimRegion region(face.loops, {0, 1, 0, 1});
  const TriangleMesh whole = tessellate(quarter_cylinder(), {.chord_mm = 0.05, .edge_mm = 0.5}).mesh;
  // The hole's area in millimetres, by a fine sum over the parameter plane.
  double hole = 0;
  constexpr int kSteps = 400;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      const double u = (i + 0.5) / kSteps, v = (j + 0.5) / kSteps;
      const SurfaceJet jet = face.surface.jet(u, v);
      if (!region.inside(u, v)) hole += jet.du.cross(jet.dv).norm() / (kSteps * kSteps);
    }
  EXPECT_NEAR(area(whole) - area(pieces.mesh), hole, 0.01 * hole);
}

TEST(Tessellate, KinksAreGridLines) {
  Face face;
  BSplineSurface& s = face.surface;
  s.degree_u = s.degree_v = 1;
  s.knots_u = {0, 0, 0.3, 1, 1};
  s.knots_v = {0, 0, 1, 1};
  s.count_u = 3;
  s.count_v = 2;
  s.poles = {{0, 0, 0}, {0, 1, 0}, {3, 0, 3}, {3, 1, 3}, {10, 0, 0}, {10, 1, 0}};
  const TriangleMesh mesh = tessellate(face, {.chord_mm = 1e-3}).mesh;
  EXPECT_TRUE(std::any_of(mesh.vertices.begin(), mesh.vertices.end(),
                          [](const Vec3& p) { return (p - Vec3(3, 0, 3)).norm() < 1e-12; }));
  EXPECT_NEAR(area(mesh), std::sqrt(18.0) + std::sqrt(58.0), 1e-9);
}

TEST(Tessellate, RefusesLengthsThatAreNone) {
  EXPECT_THROW((void)tessellate(quarter_cylinder(), {.chord_mm = 0.0}), UsageError);
  EXPECT_THROW((void)tessellate(quarter_cylinder(), {.edge_mm = std::nan("")}), UsageError);
}

}  // namespace
}  // namespace flank::internal
