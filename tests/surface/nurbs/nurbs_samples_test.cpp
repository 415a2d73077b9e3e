// Samples and areas of trimmed faces: closed forms of spheres, tori, disks and rings.
#include "flank/surface/nurbs/nurbs_samples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "surface/nurbs_fixtures.h"

namespace flank::internal {
namespace {

constexpr double kPi = std::numbers::pi;

double area(const std::vector<SurfaceSample>& samples) {
  double sum = 0.0;
  for (const SurfaceSample& s : samples) sum += s.area;
  return sum;
}

std::vector<SurfaceSample> samples(const Face& face, double spacing, int index = 0) {
  std::vector<SurfaceSample> out;
  append_samples(NurbsFace(face, 1, {}), index, spacing, out);
  return out;
}

/// A square of size 10 with a disk of radius 10 r about its middle as its only loop (the face) or as a hole.
Face with_circle(double r, bool hole) {
  Face face = test::plane(10);
  BSplineCurve2 c;
  c.degree = 2;
  c.knots = {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4};
  c.poles.resize(2, 9);
  for (int k = 0; k < 9; ++k) {
    const double angle = k * kPi / 4, reach = k % 2 == 1 ? std::numbers::sqrt2 : 1.0;
    c.poles.col(k) = Vec2(0.5 + r * reach * std::cos(angle), 0.5 + r * reach * std::sin(angle));
    c.weights.push_back(1 / reach);
  }
  if (hole) face.loops.push_back(rectangle_loop({0, 1, 0, 1}));
  face.loops.push_back({{c}});
  return face;
}

double area_by_cells(const Face& face, int cells, int depth) {
  const NurbsFace prepared(face, 1, {});
  const ParameterBox& d = prepared.domain();
  double sum = 0.0;
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j)
      sum += trimmed_area(prepared,
                          {d.u0 + (d.u1 - d.u0) * i / cells, d.u0 + (d.u1 - d.u0) * (i + 1) / cells,
                           d.v0 + (d.v1 - d.v0) * j / cells, d.v0 + (d.v1 - d.v0) * (j + 1) / cells},
                          depth);
  return sum;
}

TEST(TrimmedArea, OfWholeFacesIsTheirClosedForm) {
  EXPECT_NEAR(area_by_cells(test::plane(10), 1, 0), 100.0, 1e-12);
  EXPECT_NEAR(area_by_cells(test::cylinder(5, 20, 4), 16, 0), 200 * kPi, 1e-5);
  EXPECT_NEAR(area_by_cells(test::sphere(7), 32, 0), 4 * kPi * 49, 1e-6);
  EXPECT_NEAR(area_by_cells(test::torus(20, 6), 32, 0), 4 * kPi * kPi * 120, 1e-4);
  EXPECT_NEAR(area_by_cells(test::cone(9), 16, 0), kPi * 9 * 9 * std::numbers::sqrt2, 1e-4);
}

TEST(TrimmedArea, ComesNearerToADiskWithEachQuartering) {
  const Face disk = with_circle(0.4, false), hole = with_circle(0.3, true);
  double before = 1e300;
  for (const int depth : {1, 3, 5, 7}) {
    const double error = std::abs(area_by_cells(disk, 4, depth) - 16 * kPi);
    EXPECT_LT(error, std::max(0.7 * before, 1e-3)) << depth;
    before = error;
  }
  EXPECT_LT(before, 0.02);
  EXPECT_NEAR(area_by_cells(hole, 4, 7), 100 - 9 * kPi, 0.02);
}

TEST(NurbsSamples, AreasAddUpToTheFace) {
  for (const double spacing : {0.5, 2.0, 6.0}) {
    EXPECT_NEAR(area(samples(test::sphere(7), spacing)) / (4 * kPi * 49), 1.0, 1e-3 * (1.0 + spacing)) << spacing;
    EXPECT_NEAR(area(samples(test::torus(20, 6), spacing)) / (4 * kPi * kPi * 120), 1.0, 1e-3) << spacing;
    EXPECT_NEAR(area(samples(test::plane(10), spacing)), 100.0, 1e-10) << spacing;
  }
  EXPECT_NEAR(area(samples(with_circle(0.4, false), 0.2)) / (16 * kPi), 1.0, 2e-3);
  EXPECT_NEAR(area(samples(with_circle(0.3, true), 0.2)) / (100 - 9 * kPi), 1.0, 2e-3);
}

TEST(NurbsSamples, LieOnTheTrimmedFaceWithItsOutwardNormal) {
  for (const SurfaceSample& s : samples(test::sphere(7), 1.0, 3)) {
    EXPECT_NEAR(s.point.norm(), 7.0, 1e-12);
    EXPECT_LT((s.normal - s.point / 7.0).norm(), 1e-9);
    EXPECT_EQ(s.patch, 3);
    EXPECT_GT(s.area, 0.0);
  }
  for (const SurfaceSample& s : samples(with_circle(0.3, true), 0.7))
    EXPECT_GT((s.point - Vec3(5, 5, 0)).norm(), 3.0 - 1e-6) << "none over the hole";
  for (const SurfaceSample& s : samples(with_circle(0.4, false), 0.7))
    EXPECT_LT((s.point - Vec3(5, 5, 0)).norm(), 4.0 + 1e-6);
}

TEST(NurbsSamples, AreAboutTheSpacingApart) {
  for (const double spacing : {0.4, 1.0, 2.5}) {
    const std::vector<SurfaceSample> plate = samples(test::plane(10), spacing);
    const int n = static_cast<int>(std::ceil(10.0 / spacing));
    ASSERT_EQ(plate.size(), static_cast<std::size_t>(n * n));
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        EXPECT_LT((plate[static_cast<std::size_t>(i * n + j)].point - 10.0 / n * Vec3(i + 0.5, j + 0.5, 0)).norm(),
                  1e-9);
  }
  EXPECT_EQ(samples(test::plane(10), 1e6).size(), 1u) << "one at least";
}

/// Parameters that run unevenly do not crowd the samples.
TEST(NurbsSamples, FollowTheLengthAndNotTheParameter) {
  Face face = test::plane(10);
  BSplineSurface& s = face.surface;
  s.degree_u = 2;
  s.knots_u = {0, 0, 0, 1, 1, 1};
  s.count_u = 3;
  s.poles = {{0, 0, 0}, {0, 10, 0}, {0.5, 0, 0}, {0.5, 10, 0}, {10, 0, 0}, {10, 10, 0}};  // x = u + 9 u^2
  const std::vector<SurfaceSample> all = samples(face, 1.0);
  ASSERT_EQ(all.size(), 100u);
  for (const SurfaceSample& x : all) EXPECT_NEAR(x.area, 1.0, 0.05);
}

}  // namespace
}  // namespace flank::internal
