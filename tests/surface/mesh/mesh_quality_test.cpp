// Noise of meshes: its size, what it does not depend on, and what only looks like it.
#include "flank/surface/mesh/mesh_quality.h"

#include <gtest/gtest.h>

#include "flank/error.h"
#include "flank/surface/mesh/mesh_target.h"
#include "surface/jet_surfaces.h"

namespace flank::internal {
namespace {

TriangleMesh rough_sheet(double sigma, std::uint64_t seed) {
  TriangleMesh mesh = shapes::sheet(30, 30, 28, 28);
  shapes::shake(mesh, sigma, seed);
  return mesh;
}

TEST(MeshQuality, MeasuresTheNoiseInMillimetres) {
  for (const double sigma : {1e-3, 1e-2, 5e-2}) {
    const MeshQuality quality = estimate_noise(rough_sheet(sigma, 1));
    EXPECT_TRUE(quality.noisy);
    EXPECT_NEAR(quality.noise_mm, sigma, 0.12 * sigma);
    EXPECT_NEAR(quality.noise_relative * std::hypot(30.0, 30.0), quality.noise_mm, 0.01 * sigma);
    EXPECT_NEAR(quality.jets.allowance, 6.0 * quality.noise_mm, 1e-15);
  }
}

TEST(MeshQuality, ScalesWithTheMeshAndMovesWithIt) {
  TriangleMesh mesh = rough_sheet(1e-2, 2), moved = mesh;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vec3(2, -1, 1).normalized()).toRotationMatrix();
  for (Vec3& x : moved.vertices) x = 10.0 * (turn * x) + Vec3(7, 8, 9);
  const MeshQuality a = estimate_noise(mesh), b = estimate_noise(moved);
  EXPECT_NEAR(b.noise_mm, 10.0 * a.noise_mm, 1e-6 * b.noise_mm);
  EXPECT_EQ(a.jets.points, b.jets.points);
}

TEST(MeshQuality, DoesNotSeeNoiseAlongTheSurface) {
  TriangleMesh mesh = shapes::sheet(30, 30, 28, 28);
  Random random(3);
  for (Vec3& x : mesh.vertices) x += 0.1 * Vec3(random.normal(), random.normal(), 0.0);
  const MeshQuality quality = estimate_noise(mesh);
  EXPECT_FALSE(quality.noisy);
  EXPECT_LT(quality.noise_mm, 1e-12);
}

TEST(MeshQuality, ARoundingToSinglePrecisionIsNoNoise) {
  TriangleMesh mesh = shapes::torus(20, 8, 90, 45);
  for (Vec3& x : mesh.vertices) x = x.cast<float>().cast<double>();
  const MeshQuality quality = estimate_noise(mesh);
  EXPECT_FALSE(quality.noisy);
  EXPECT_EQ(quality.jets.points, JetOptions{}.points);
  EXPECT_EQ(quality.jets.falloff, JetOptions{}.falloff);
}

TEST(MeshQuality, ShapeThatJetsCannotFollowIsNoNoise) {
  // Waves of twenty triangles: wider jets leave more, so they are shape.
  const TriangleMesh waves = shapes::grid(
      60, 60, [](double u, double v) { return Vec3(60 * u, 60 * v, 0.4 * std::sin(18 * u) * std::cos(18 * v)); });
  const MeshQuality quality = estimate_noise(waves);
  EXPECT_GT(quality.noise_relative, kExactNoise);
  EXPECT_FALSE(quality.noisy);
}

/// The flatter the shape beside the noise, the wider the jets may be.
TEST(MeshQuality, MoreNoiseAsksForWiderJets) {
  const auto points = [](double sigma) {
    TriangleMesh mesh = shapes::twisted(45);
    shapes::shake(mesh, sigma, 4);
    return estimate_noise(mesh).jets.points;
  };
  EXPECT_GE(points(3e-2), points(1e-3));
  EXPECT_GT(points(3e-2), 100);
}

TEST(MeshQuality, RepairsWhatItIsGivenAndRefusesWhatIsNone) {
  TriangleMesh mesh = rough_sheet(1e-2, 5);
  const double sound = estimate_noise(mesh).noise_mm;
  mesh.triangles.push_back({4, 4, 5});
  mesh.vertices.emplace_back(1e4, 0, 0);
  EXPECT_NEAR(estimate_noise(mesh).noise_mm, sound, 1e-3 * sound);
  EXPECT_THROW((void)estimate_noise(TriangleMesh{}), InputError);
}

TEST(MeshQuality, ATriangleAloneIsExact) {
  TriangleMesh one;
  one.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  one.triangles = {{0, 1, 2}};
  const MeshQuality quality = estimate_noise(one);
  EXPECT_FALSE(quality.noisy);
  EXPECT_EQ(quality.noise_mm, 0.0);
}

}  // namespace
}  // namespace flank::internal
