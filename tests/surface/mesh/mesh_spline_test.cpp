// Splines in place of noisy meshes.
#include "flank/surface/mesh/mesh_spline.h"

#include <gtest/gtest.h>

#include "flank/surface/mesh/mesh_target.h"
#include "flank/surface/mesh/scattered_spline.h"
#include "surface/mesh_shapes.h"

namespace flank::internal {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int kSide = 40;
#else
constexpr int kSide = 113;
#endif

Vec3 twisted_normal(double u, double v) {
  const double h = 1e-6;
  const Vec3 du = shapes::twisted_point(u + h, v) - shapes::twisted_point(u - h, v);
  const Vec3 dv = shapes::twisted_point(u, v + h) - shapes::twisted_point(u, v - h);
  return du.cross(dv).normalized();
}

struct Error {
  double largest = 0.0, mean_square = 0.0;
  int inside = 0;
};

/// Of the distances of points 1 mm above the truth, relative to the diagonal.
Error against_truth(const Target& target, double diagonal) {
  Random random(4);
  Error e;
  for (int i = 0; i < 1000; ++i) {
    const double u = random.uniform(), v = random.uniform();
    const Footpoint f = target.closest(shapes::twisted_point(u, v) + twisted_normal(u, v));
    if (f.location != Location::kInside) continue;
    const double d = std::abs(f.distance - 1.0) / diagonal;
    e.largest = std::max(e.largest, d);
    e.mean_square += d * d;
    ++e.inside;
  }
  e.mean_square /= e.inside;
  return e;
}

TEST(ScatteredSpline, ReproducesASplineAndStaysDeterminedWithoutData) {
  std::vector<Vec3> points;
  std::vector<Vec2> parameters;
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const double u = random.uniform(), v = random.uniform();
    if (u > 0.6 && v > 0.6) continue;  // a corner without data
    parameters.emplace_back(u, v);
    points.emplace_back(10.0 * u, 20.0 * v, u * u * v + v * v * v - u);
  }
  const BSplineSurface s = fit_scattered(points, parameters, {3, 9, 12, 1e-12});
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_NEAR((s.value(parameters[i][0], parameters[i][1]) - points[i]).norm(), 0.0, 1e-7);
  EXPECT_NEAR((s.value(1.0, 1.0) - Vec3(10.0, 20.0, 1.0)).norm(), 0.0, 3.0);
}

TEST(MeshSpline, FollowsASmoothPatchClosely) {
  const TriangleMesh mesh = shapes::twisted(kSide);
  const auto spline = fit_spline_to_mesh(mesh);
  ASSERT_TRUE(spline.has_value());
  EXPECT_TRUE(spline->face.loops.empty());
  const double diagonal = mesh.box().diagonal();
  const Error e = against_truth(*make_target(std::vector<Face>{spline->face}), diagonal);
  EXPECT_LT(e.largest, kSide > 100 ? 1e-7 : 1e-5);
  EXPECT_GT(e.inside, 990);
}

TEST(MeshSpline, TakesTheNoiseOutAndKeepsTheNormal) {
  for (const bool turned : {false, true}) {
    TriangleMesh mesh = shapes::twisted(kSide);
    const double diagonal = mesh.box().diagonal();
    shapes::shake(mesh, 1e-4 * diagonal, 3);
    if (turned)
      for (auto& t : mesh.triangles) std::swap(t[0], t[1]);
    const auto spline = fit_spline_to_mesh(mesh);
    ASSERT_TRUE(spline.has_value());
    EXPECT_NEAR(spline->residual_mm / diagonal, 1e-4, 5e-6);
    const auto target = make_target(std::vector<Face>{spline->face});
    const Footpoint f = target->closest(shapes::twisted_point(0.4, 0.6) + twisted_normal(0.4, 0.6));
    EXPECT_NEAR(f.distance, turned ? -1.0 : 1.0, 3e-5 * diagonal);
  }
}

TEST(MeshSpline, NoisyMeshBecomesASplineTarget) {
  TriangleMesh mesh = shapes::twisted(kSide);
  const double diagonal = mesh.box().diagonal();
  shapes::shake(mesh, 1e-4 * diagonal, 3);
  const auto target = make_target(mesh);
  EXPECT_EQ(target->patch_count(), 1);
  const Error e = against_truth(*target, diagonal);
  // The noise averages out over the vertices that each of about 100 control points sees; corners see a quarter of them.
  const double vertices = kSide > 100 ? 1.0 : 3.0;  // a smaller mesh leaves that much more
  EXPECT_LT(std::sqrt(e.mean_square), vertices * 1e-5);
  EXPECT_LT(e.largest, vertices * 5e-5);
}

TEST(MeshSpline, NoisyMeshWithoutASplineGetsWiderJets) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a measurement; the code it runs is covered by the other tests";
#endif
  TriangleMesh mesh = shapes::torus(20, 8, 160, 81);
  const double diagonal = mesh.box().diagonal();
  shapes::shake(mesh, 2e-4 * diagonal, 3);
  EXPECT_FALSE(fit_spline_to_mesh(mesh).has_value());
  const auto target = make_target(mesh);
  EXPECT_EQ(target->patch_count(), static_cast<int>(mesh.triangles.size()));
  Random random(2);
  double sum = 0.0;
  for (int i = 0; i < 500; ++i) {
    const Vec3 p = shapes::torus_point(20, 9, random.uniform(), random.uniform());
    const double d = target->closest(p).distance - 1.0;
    sum += d * d / 500.0;
  }
  EXPECT_LT(std::sqrt(sum) / diagonal, 1e-4);  // half of the noise
}

TEST(MeshSpline, HolesBecomeTrims) {
  TriangleMesh mesh = shapes::twisted(60);
  shapes::cut(mesh, [](const Vec3& x) { return std::hypot(x[0] - 5, x[1] - 8) < 6; });
  const auto spline = fit_spline_to_mesh(mesh);
  ASSERT_TRUE(spline.has_value());
  EXPECT_EQ(spline->face.loops.size(), 2u);
  const auto target = make_target(std::vector<Face>{spline->face});
  EXPECT_EQ(target->closest(Vec3(5, 8, 6)).location, Location::kBorder);
  EXPECT_EQ(target->closest(shapes::twisted_point(0.2, 0.2)).location, Location::kInside);
}

TEST(MeshSpline, RoundPatchIsTrimmedByItsRim) {
  TriangleMesh mesh = shapes::twisted(60);
  shapes::cut(mesh, [](const Vec3& x) { return std::hypot(x[0], x[1]) > 19; });
  const auto spline = fit_spline_to_mesh(mesh);
  ASSERT_TRUE(spline.has_value());
  EXPECT_EQ(spline->face.loops.size(), 1u);
  const auto target = make_target(std::vector<Face>{spline->face});
  EXPECT_NEAR(target->area(), MeshTarget(mesh, {}).area(), 0.5);
}

TEST(MeshSpline, RefusesWhatIsNoDisk) {
  EXPECT_FALSE(fit_spline_to_mesh(shapes::sphere(10, 10)).has_value());
  const auto tube = [](double u, double v) {
    const double a = 2.0 * std::numbers::pi * u;
    return Vec3(5.0 * std::cos(a), 5.0 * std::sin(a), 20.0 * v);
  };
  EXPECT_FALSE(fit_spline_to_mesh(shapes::grid(30, 10, tube, true, false)).has_value());
  TriangleMesh two = shapes::twisted(10), other = two;
  for (Vec3& x : other.vertices) x[2] += 50.0;
  for (auto& t : other.triangles)
    for (int& v : t) v += static_cast<int>(two.vertices.size());
  two.vertices.insert(two.vertices.end(), other.vertices.begin(), other.vertices.end());
  two.triangles.insert(two.triangles.end(), other.triangles.begin(), other.triangles.end());
  EXPECT_FALSE(fit_spline_to_mesh(two).has_value());
}

}  // namespace
}  // namespace flank::internal
