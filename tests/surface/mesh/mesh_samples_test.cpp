// Samples of a mesh: their areas, where they lie, and meshes coarser and finer than the spacing.
#include "flank/surface/mesh/mesh_samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flank/error.h"
#include "surface/jet_surfaces.h"

namespace flank::internal {
namespace {

double total_area(const std::vector<SurfaceSample>& samples) {
  double sum = 0.0;
  for (const SurfaceSample& s : samples) sum += s.area;
  return sum;
}

TEST(MeshSamples, AreasAddUpToTheSurfaceForEverySpacing) {
  const JetSurface torus = shapes::jet_surface(shapes::torus(20, 8, 60, 30));
  const double area = 4.0 * std::numbers::pi * std::numbers::pi * 160.0;
  for (const double spacing : {0.7, 2.0, 5.0, 20.0, 500.0})
    EXPECT_NEAR(total_area(mesh_samples(torus, spacing, SamplePlaces::kBlended)) / area, 1.0, 1e-5) << spacing;
}

TEST(MeshSamples, LieOnTheSurfaceWithItsNormal) {
  const JetSurface ball = shapes::jet_surface(shapes::sphere(10, 12));
  for (const double spacing : {0.5, 3.0})
    for (const SurfaceSample& s : mesh_samples(ball, spacing, SamplePlaces::kBlended)) {
      EXPECT_NEAR(s.point.norm(), 10.0, 1e-3);
      EXPECT_NEAR(s.normal.norm(), 1.0, 1e-14);
      EXPECT_GT(s.normal.dot(s.point) / 10.0, 0.9999);
      EXPECT_GT(s.area, 0.0);
      const SurfaceJet jet = ball.jet(s.patch, s.u, s.v);
      EXPECT_EQ(jet.p, s.point) << "patch, u and v say where";
    }
}

/// What a judge sees of a coarse mesh: its triangles, up to 0.6 mm below the ball that they stand for.
TEST(MeshSamples, OfFacetsLieOnTheTriangles) {
  const JetSurface ball = shapes::jet_surface(shapes::sphere(10, 4));
  for (const double spacing : {0.5, 3.0, 50.0}) {
    const std::vector<SurfaceSample> flat = mesh_samples(ball, spacing, SamplePlaces::kFacets),
                                     round = mesh_samples(ball, spacing, SamplePlaces::kBlended);
    ASSERT_EQ(flat.size(), round.size());
    double deepest = 0.0;
    for (std::size_t k = 0; k < flat.size(); ++k) {
      const Vec3 a = ball.corner(flat[k].patch, 0), b = ball.corner(flat[k].patch, 1),
                 c = ball.corner(flat[k].patch, 2);
      EXPECT_NEAR((b - a).cross(c - a).normalized().dot(flat[k].point - a), 0.0, 1e-12);
      EXPECT_EQ(flat[k].normal, round[k].normal);
      EXPECT_EQ(flat[k].area, round[k].area);
      deepest = std::max(deepest, 10.0 - flat[k].point.norm());
    }
    EXPECT_GT(deepest, 0.1) << spacing;
  }
}

/// The mean of the samples, weighted by their areas, is the centroid of what they stand for.
TEST(MeshSamples, HaveTheCentroidOfTheSurface) {
  const JetSurface plate = shapes::jet_surface(shapes::sheet(30, 10, 45, 15));
  for (const double spacing : {0.2, 1.0, 3.0}) {
    Vec3 mean = Vec3::Zero();
    const std::vector<SurfaceSample> samples = mesh_samples(plate, spacing, SamplePlaces::kBlended);
    for (const SurfaceSample& s : samples) mean += s.area * s.point / 300.0;
    EXPECT_LT((mean - Vec3(15, 5, 0)).norm(), 0.1 * spacing) << spacing;
    EXPECT_NEAR(static_cast<double>(samples.size()) * spacing * spacing / 300.0, 1.0, 0.5) << spacing;
  }
}

TEST(MeshSamples, EveryPlaceHasOneNearby) {
  const JetSurface plate = shapes::jet_surface(shapes::sheet(20, 20, 40, 40));
  for (const double spacing : {0.3, 1.0, 2.0}) {
    const std::vector<SurfaceSample> samples = mesh_samples(plate, spacing, SamplePlaces::kBlended);
    Random random(1);
    for (int k = 0; k < 100; ++k) {
      const Vec3 p(random.uniform(0, 20), random.uniform(0, 20), 0.0);
      double least = 1e300;
      for (const SurfaceSample& s : samples) least = std::min(least, (s.point - p).norm());
      EXPECT_LT(least, 2.0 * spacing) << spacing;
    }
  }
}

TEST(MeshSamples, DivideALargeTriangleEvenly) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {12, 0, 0}, {0, 12, 0}};
  mesh.triangles = {{0, 1, 2}};
  const JetSurface surface = shapes::jet_surface(mesh);
  const std::vector<SurfaceSample> samples = mesh_samples(surface, 1.0, SamplePlaces::kBlended);
  const auto n = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(samples.size()))));
  EXPECT_EQ(n * n, samples.size()) << "n^2 similar triangles";
  EXPECT_GE(n, 7u);
  for (const SurfaceSample& s : samples) EXPECT_NEAR(s.area, 72.0 / static_cast<double>(n * n), 1e-12);
  for (std::size_t i = 0; i < samples.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) EXPECT_GT((samples[i].point - samples[k].point).norm(), 0.3);
}

TEST(MeshSamples, ALongThinTriangleIsCutAlongItsLength) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {60, 0, 0}, {0, 0.5, 0}};
  mesh.triangles = {{0, 1, 2}};
  const std::vector<SurfaceSample> samples = mesh_samples(shapes::jet_surface(mesh), 2.0, SamplePlaces::kBlended);
  EXPECT_GE(samples.size(), 100u) << "ten parts of its long sides, though its area is less than four cells";
  EXPECT_NEAR(total_area(samples), 15.0, 1e-12);
}

TEST(MeshSamples, OneCellForAllThatIsSmallAndFlatAndSeveralForWhatIsBent) {
  const JetSurface plate = shapes::jet_surface(shapes::sheet(2, 2, 8, 8));
  const std::vector<SurfaceSample> one = mesh_samples(plate, 100.0, SamplePlaces::kBlended);
  ASSERT_EQ(one.size(), 1u);
  EXPECT_LT((one[0].point - Vec3(1, 1, 0)).norm(), 1e-9);
  const JetSurface ball = shapes::jet_surface(shapes::sphere(1, 8));
  const std::vector<SurfaceSample> bent = mesh_samples(ball, 100.0, SamplePlaces::kBlended);
  EXPECT_GE(bent.size(), 6u) << "no sample stands for places whose normals differ by more than 60 degrees";
  Vec3 closed = Vec3::Zero();
  for (const SurfaceSample& s : bent) closed += s.normal;
  EXPECT_LT(closed.norm(), 0.4 * static_cast<double>(bent.size())) << "on all sides";
}

TEST(MeshSamples, AreTheSameEachTime) {
  const JetSurface surface = shapes::jet_surface(shapes::twisted(25));
  const std::vector<SurfaceSample> a = mesh_samples(surface, 3.0, SamplePlaces::kBlended),
                                   b = mesh_samples(surface, 3.0, SamplePlaces::kBlended);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_EQ(a[k].point, b[k].point);
    EXPECT_EQ(a[k].area, b[k].area);
  }
}

TEST(MeshSamples, RefuseASpacingThatIsNone) {
  const JetSurface surface = shapes::jet_surface(shapes::sheet(2, 2, 2, 2));
  for (const double spacing : {0.0, -1.0, std::nan("")}) {
    try {
      (void)mesh_samples(surface, spacing, SamplePlaces::kBlended);
      FAIL() << spacing;
    } catch (const UsageError& e) {
      EXPECT_NE(std::string(e.what()).find("spacing must be positive"), std::string::npos) << e.what();
    }
  }
}

}  // namespace
}  // namespace flank::internal
