#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "flank/base/random.h"
#include "flank/error.h"
#include "flank/judge.h"
#include "flank/verify/sample_face.h"
#include "verify/faces.h"

namespace flank::internal {
namespace {

constexpr double kPi = 3.14159265358979323846;

double total(const FaceSamples& s) { return std::accumulate(s.areas.begin(), s.areas.end(), 0.0); }

double nearest(const FaceSamples& s, const Vec3& x) {
  double least = 1e300;
  for (const Vec3& p : s.points) least = std::min(least, (p - x).norm());
  return least;
}

TEST(SampleFace, WholePlane) {
  const FaceSamples s = sample_face(test::plane_face("F7", 10.0, 4.0), 0.5, true);
  EXPECT_EQ(s.face, "F7");
  EXPECT_TRUE(s.target);
  EXPECT_EQ(s.points.size(), 20u * 8u);
  EXPECT_NEAR(total(s), 40.0, 1e-10);
  EXPECT_NEAR(s.spacing_mm, 0.25 * std::sqrt(2.0), 1e-12);
  EXPECT_EQ(*std::max_element(s.curvatures_per_mm.begin(), s.curvatures_per_mm.end()), 0.0);
  EXPECT_EQ(*std::max_element(s.reaches_mm.begin(), s.reaches_mm.end()), s.spacing_mm);
  EXPECT_NEAR((s.points.front() - Vec3(0.25, 0, 0.25)).norm(), 0.0, 1e-12);
}

TEST(SampleFace, QuarterCylinderHasItsAreaItsSpacingAndItsCurvature) {
  const FaceSamples s = sample_face(test::quarter_cylinder("F1", 5.0, 12.0), 0.3, true);
  EXPECT_NEAR(total(s), 0.5 * kPi * 5.0 * 12.0, 0.02);
  for (double k : s.curvatures_per_mm) EXPECT_NEAR(k, 0.2, 1e-9);
  EXPECT_LT(s.spacing_mm, 0.3 * 0.75);
  Random random(3);
  for (int i = 0; i < 300; ++i) {
    const double a = random.uniform(0.0, 0.5 * kPi);
    EXPECT_LE(nearest(s, {5.0 * std::cos(a), 5.0 * std::sin(a), random.uniform(0.0, 12.0)}), s.spacing_mm);
  }
}

TEST(SampleFace, UnevenParametersStillKeepTheSpacing) {
  Face face = test::plane_face("F1", 10.0, 1.0);
  BSplineSurface& s = face.surface;
  s.degree_u = 2;
  s.knots_u = {0, 0, 0, 1, 1, 1};
  s.count_u = 3;
  // x(u) = 10 u^2: the cells near u = 0 would be far smaller with equal steps of u.
  s.poles = {Vec3(0, 0, 0), Vec3(0, 0, 1), Vec3(0, 0, 0), Vec3(0, 0, 1), Vec3(10, 0, 0), Vec3(10, 0, 1)};
  const FaceSamples samples = sample_face(face, 0.25, true);
  EXPECT_LT(samples.spacing_mm, 0.25);
  EXPECT_LT(samples.points.size(), 220u);
  EXPECT_NEAR(total(samples), 10.0, 0.05);
}

TEST(SampleFace, RespectsOuterLoopAndHole) {
  Face face = test::plane_face("F1", 10.0, 10.0);
  face.loops = {test::polygon({{0.1, 0.2}, {0.9, 0.2}, {0.9, 0.8}, {0.1, 0.8}}), test::circle({0.5, 0.5}, 0.2)};
  const FaceSamples s = sample_face(face, 0.1, true);
  EXPECT_NEAR(total(s), 48.0 - kPi * 4.0, 0.05);
  for (const Vec3& p : s.points) {
    EXPECT_TRUE(p.x() >= 1.0 && p.x() <= 9.0 && p.z() >= 2.0 && p.z() <= 8.0) << p.transpose();
    EXPECT_GE(std::hypot(p.x() - 5.0, p.z() - 5.0), 2.0 - 2e-4) << p.transpose();
  }
}

TEST(SampleFace, TheSizeIsThatOfTheFaceNotOfItsParameters) {
  // Sheared, so that a band from one corner of the parameters to another one is low: 10 mm wide, 3 mm high.
  Face face = test::plane_face("F1", 10.0, 10.0);
  for (Vec3& pole : face.surface.poles) pole.z() += pole.x();
  face.loops = {test::polygon({{0.0, 0.9}, {0.0, 1.0}, {0.1, 1.0}, {1.0, 0.1}, {1.0, 0.0}, {0.9, 0.0}})};
  const double size = verify::make_sampler(face, 0.1, true, 1 << 16)->size_mm();
  EXPECT_GE(size, 10.0);
  EXPECT_LE(size, std::hypot(10.0, 3.0));
}

TEST(SampleFace, PartsOfCellsTileThem) {
  Face face = test::quarter_cylinder("F1", 5.0, 8.0);
  face.loops = {test::circle({0.5, 0.5}, 0.4)};
  const auto sampler = verify::make_sampler(face, 1.0, true, 1 << 16);
  const FaceSamples all = sampler->tile(0);
  for (std::size_t i = 0; i < all.points.size(); i += 3) {
    const FaceSamples parts = sampler->cut(all, std::array{i});
    EXPECT_LE(parts.points.size(), 16u);
    EXPECT_TRUE(parts.target);
    // On the trim both are estimates.
    EXPECT_NEAR(total(parts), all.areas[i], all.smooth[i] != 0 ? 1e-4 : 0.05);
    for (std::size_t k = 0; k < parts.points.size(); ++k) {
      EXPECT_LE((parts.points[k] - all.points[i]).norm(), 2.0 * all.reaches_mm[i]);
      EXPECT_GE(parts.cells[k][0], all.cells[i][0]);
      EXPECT_LE(parts.cells[k][1], all.cells[i][1]);
    }
    EXPECT_LT(parts.spacing_mm, 0.3 * all.spacing_mm);
  }
}

TEST(SampleFace, ATrimThinnerThanACellIsNotLost) {
  Face face = test::plane_face("F1", 10.0, 10.0);
  face.loops = {test::polygon({{0.1, 0.42}, {0.9, 0.42}, {0.9, 0.45}, {0.1, 0.45}})};
  const FaceSamples s = sample_face(face, 1.0, true);
  EXPECT_FALSE(s.points.empty());
  EXPECT_NEAR(total(s), 2.4, 1e-4) << "a trim along iso-lines cuts no cell";
}

TEST(SampleFace, RefusesASpacingThatIsNone) {
  EXPECT_THROW((void)sample_face(test::plane_face("F1", 1, 1), 0.0, true), UsageError);
  EXPECT_THROW((void)sample_face(test::plane_face("F1", 1, 1), -1.0, true), UsageError);
}

TEST(SampleMesh, TrianglesKeepAreaAndSpacing) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {4, 0, 0}, {0, 3, 0}, {4, 3, 1}};
  mesh.triangles = {{0, 1, 2}, {1, 3, 2}};
  const FaceSamples s = sample_mesh("mesh", mesh, 0.4, true);
  const double second = 0.5 * (mesh.vertices[3] - mesh.vertices[1]).cross(mesh.vertices[2] - mesh.vertices[1]).norm();
  EXPECT_NEAR(total(s), 6.0 + second, 1e-10);
  Random random(5);
  for (int i = 0; i < 300; ++i) {
    double a = random.uniform(), b = random.uniform();
    if (a + b > 1.0) a = 1.0 - a, b = 1.0 - b;
    EXPECT_LE(nearest(s, {4.0 * a, 3.0 * b, 0.0}), s.spacing_mm + 1e-12);
  }
  EXPECT_LT(s.spacing_mm, 0.4);
}

}  // namespace
}  // namespace flank::internal
