// Footpoints on meshes: closed forms, borders, holes, extension, noise, damaged input.
#include "flank/surface/mesh/mesh_target.h"

#include <gtest/gtest.h>

#include "flank/base/random.h"
#include "flank/error.h"
#include "surface/mesh_shapes.h"

namespace flank::internal {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int kPoints = 200;
constexpr int kSide = 40;
#else
constexpr int kPoints = 4000;
constexpr int kSide = 113;
#endif

Vec3 twisted_normal(double u, double v) {
  const double h = 1e-6;
  const Vec3 du = shapes::twisted_point(u + h, v) - shapes::twisted_point(u - h, v);
  const Vec3 dv = shapes::twisted_point(u, v + h) - shapes::twisted_point(u, v - h);
  return du.cross(dv).normalized();
}

TEST(MeshTarget, TorusHasItsClosedForm) {
  const MeshTarget target(shapes::torus(20, 8, 160, 81), {});
  EXPECT_NEAR(target.area() / (4.0 * std::numbers::pi * std::numbers::pi * 160.0), 1.0, 1e-7);
  Random random(1);
  for (int i = 0; i < kPoints; ++i) {
    const Vec3 p(random.uniform(-40, 40), random.uniform(-40, 40), random.uniform(-20, 20));
    const double ring = std::hypot(p[0], p[1]), rho = std::hypot(ring - 20.0, p[2]);
    if (rho < 0.5 || ring < 0.5) continue;
    const Footpoint f = target.closest(p);
    EXPECT_EQ(f.location, Location::kInside);
    EXPECT_NEAR(f.distance, rho - 8.0, 1e-7 * target.diagonal());
    const double c = (ring - 20.0) / rho;
    const Vec3 normal(p[0] / ring * c, p[1] / ring * c, p[2] / rho);
    EXPECT_LT((f.normal - normal).norm(),
              3e-4);  // tangential error of the footpoint, enlarged where p is near the focal circle
    EXPECT_LT((p - f.point - f.distance * f.normal).norm(), 1e-9);
    const double tube = -1.0 / 8.0, around = -c / (20.0 + 8.0 * c);
    EXPECT_NEAR(f.k1, std::min(tube, around), 1e-3);
    EXPECT_NEAR(f.k2, std::max(tube, around), 1e-3);
    EXPECT_NEAR(f.d1.dot(f.d2), 0.0, 1e-12);
    EXPECT_NEAR(f.d1.dot(f.normal), 0.0, 1e-12);
    // The direction around the axis belongs to the smaller curvature in size.
    EXPECT_LT(std::abs(f.d2.dot(Vec3(-p[1], p[0], 0.0) / ring)), 1.0 + 1e-12);
    EXPECT_GT(std::abs(f.d2.dot(Vec3(-p[1], p[0], 0.0) / ring)), 1.0 - 1e-4);
  }
}

TEST(MeshTarget, CurvatureIsPositiveWhereTheSurfaceBendsTowardsTheMachiningSide) {
  TriangleMesh bowl = shapes::sphere(10, 24);
  for (auto& t : bowl.triangles) std::swap(t[1], t[2]);
  const Footpoint inside = MeshTarget(bowl, {}).closest(Vec3(1, 2, 3));
  EXPECT_NEAR(inside.k1, 0.1, 1e-4);
  EXPECT_NEAR(inside.k2, 0.1, 1e-4);
  EXPECT_NEAR(inside.distance, 10.0 - Vec3(1, 2, 3).norm(), 1e-5);
  const Footpoint ridge = MeshTarget(shapes::saddle(10, 20, 30), {}).closest(Vec3(0, 0, 1));
  EXPECT_NEAR(ridge.k1, -0.05, 1e-4);
  EXPECT_NEAR(ridge.k2, 0.05, 1e-4);
  EXPECT_NEAR(ridge.distance, 1.0, 1e-9);
}

TEST(MeshTarget, ClosestIsTheSmallestOverDenseSamplesAlsoAtTheBorder) {
  const MeshTarget target(shapes::twisted(30), {});
  std::vector<Vec3> dense;
  for (int i = 0; i <= 400; ++i)
    for (int j = 0; j <= 400; ++j) dense.push_back(shapes::twisted_point(i / 400.0, j / 400.0));
  Random random(2);
  int border = 0;
  for (int i = 0; i < kPoints / 20; ++i) {
    const Vec3 p(random.uniform(-40, 40), random.uniform(-50, 50), random.uniform(-25, 25));
    double least = std::numeric_limits<double>::infinity();
    for (const Vec3& x : dense) least = std::min(least, (x - p).norm());
    const Footpoint f = target.closest(p);
    EXPECT_NEAR((f.point - p).norm(), std::abs(f.distance), 1e-9);
    // Between two vertices the mesh's border is a chord, which may lie inside of the surface's border by its sagitta.
    EXPECT_LT(std::abs(f.distance), least + (f.location == Location::kBorder ? 3e-3 : 1e-5));
    EXPECT_GT(std::abs(f.distance), least - 0.02);
    EXPECT_NE(f.location, Location::kExtension);
    if (f.location == Location::kInside) {
      EXPECT_LT((p - f.point - f.distance * f.normal).norm(), 1e-8);
    }
    border += f.location == Location::kBorder;
  }
  EXPECT_GT(border, kPoints / 200);
}

TEST(MeshTarget, CornerOfTheBorderHoldsWhatLiesBeyondIt) {
  const MeshTarget target(shapes::saddle(10, 1e9, 20), {});
  const Footpoint corner = target.closest(Vec3(13, 14, 0.5));
  EXPECT_EQ(corner.location, Location::kBorder);
  EXPECT_NEAR((corner.point - Vec3(10, 10, 0)).norm(), 0.0, 1e-6);
  EXPECT_NEAR(corner.distance, Vec3(3, 4, 0.5).norm(), 1e-6);
  const Footpoint side = target.closest(Vec3(13, 3.21, -0.5));
  EXPECT_NEAR((side.point - Vec3(10, 3.21, 0)).norm(), 0.0, 1e-6);
  EXPECT_NEAR(side.distance, -Vec3(3, 0, 0.5).norm(), 1e-6);
}

TEST(MeshTarget, TrackFollowsClosestInsideAndIsTheGradient) {
  const MeshTarget target(shapes::twisted(kSide), {});
  Footpoint hint;
  for (int i = 0; i < kPoints / 4; ++i) {
    const double a = 0.03 * i, u = 0.5 + 0.4 * std::cos(a), v = 0.5 + 0.4 * std::sin(1.7 * a);
    const Vec3 p = shapes::twisted_point(u, v) + 3.0 * twisted_normal(u, v);
    hint = target.track(p, hint);
    const Footpoint cold = target.closest(p);
    ASSERT_EQ(hint.location, Location::kInside);
    EXPECT_NEAR(hint.distance, cold.distance, 1e-11);
    EXPECT_NEAR(hint.distance, 3.0, 1e-7 * target.diagonal());
    EXPECT_LT((hint.point - cold.point).norm(), 1e-8);
    const Vec3 step = 1e-4 * Vec3(std::cos(a), std::sin(3 * a), std::sin(a));
    const double change = target.track(p + step, hint).distance - target.track(p - step, hint).distance;
    EXPECT_NEAR(change, 2.0 * step.dot(hint.normal), 1e-9);
  }
}

TEST(MeshTarget, HintFarAwayStillArrives) {
  const MeshTarget target(shapes::twisted(kSide), {});
  const Footpoint start = target.closest(shapes::twisted_point(0.05, 0.1));
  const Vec3 p = shapes::twisted_point(0.9, 0.85) + 2.0 * twisted_normal(0.9, 0.85);
  EXPECT_NEAR(target.track(p, start).distance, 2.0, 1e-5);
}

TEST(MeshTarget, ExtensionContinuesTheSurfaceSmoothly) {
  const MeshTarget target(shapes::twisted(kSide), {});
  Footpoint hint;
  double last = 0.0;
  for (int i = 0; i <= 300; ++i) {
    const double u = 0.9 + 0.19 * i / 300.0, v = 0.37;
    const Vec3 p = shapes::twisted_point(u, v) + 2.0 * twisted_normal(u, v);
    hint = target.track(p, hint);
    EXPECT_EQ(hint.location, u < 1.0 - 1e-9   ? Location::kInside
                             : u > 1.0 + 1e-9 ? Location::kExtension
                                              : hint.location);
    // A cubic over 18 percent (7 mm), continued by 10 percent (4 mm): its error is f''''/24 times the distances to its
    // zeros, with f'''' = 3 / 14^4 about 1e-2 mm at the end.
    EXPECT_NEAR(hint.distance, 2.0, 1e-2);
    if (i > 0) {
      EXPECT_NEAR(hint.distance, last, 2e-4);
    }
    last = hint.distance;
    const Vec3 step(1e-4, 0.0, 2e-5);
    const double change = target.track(p + step, hint).distance - target.track(p - step, hint).distance;
    EXPECT_NEAR(change, 2.0 * step.dot(hint.normal), 1e-8);
    EXPECT_NE(target.closest(p).location, Location::kExtension);
  }
}

TEST(MeshTarget, HolesAreCrossedOnTheExtension) {
  TriangleMesh mesh = shapes::twisted(kSide);
  shapes::cut(mesh, [](const Vec3& x) {
    return std::hypot(x[0] - 5, x[1] - 8) < 4 || (std::abs(x[0] + 8) < 3 && std::abs(x[1] + 10) < 5);
  });
  const MeshTarget target(mesh, {});
  Random random(5);
  int over = 0;
  for (int i = 0; i < kPoints; ++i) {
    const double u = random.uniform(), v = random.uniform();
    const Vec3 x = shapes::twisted_point(u, v), p = x + twisted_normal(u, v);
    const Footpoint f = target.track(p, {});
    EXPECT_NEAR(f.distance, 1.0, 5e-5);
    const bool hole = std::hypot(x[0] - 5, x[1] - 8) < 3.2 || (std::abs(x[0] + 8) < 2.2 && std::abs(x[1] + 10) < 4.2);
    over += hole;
    if (hole) {
      EXPECT_EQ(f.location, Location::kExtension);
    }
    if (hole) {
      EXPECT_EQ(target.closest(p).location, Location::kBorder);
    }
  }
  EXPECT_GT(over, kPoints / 100);  // the holes are 3 percent of the area
}

TEST(MeshTarget, TubeIsExtendedAtBothEnds) {
  const auto tube = [](double u, double v) {
    const double a = 2.0 * std::numbers::pi * u;
    return Vec3(5.0 * std::cos(a), 5.0 * std::sin(a), 20.0 * v);
  };
  const MeshTarget target(shapes::grid(60, 40, tube, true, false), {});
  for (double z : {-1.8, -0.5, 10.0, 20.5, 21.8}) {
    const Footpoint f = target.track(Vec3(4.0, 5.0, z), {});
    // The far fit is a cubic over 1.8 mm to both sides of a circle: it leaves 3/35 of x^4 / (8 r^3).
    const bool beyond = z < 0 || z > 20;
    EXPECT_NEAR(f.distance, std::hypot(4.0, 5.0) - 5.0, beyond ? 1e-3 : 1e-6) << z;
    EXPECT_EQ(f.location, beyond ? Location::kExtension : Location::kInside);
  }
}

TEST(MeshTarget, SharpEdgesStaySharp) {
  const auto roof = [](double u, double v) { return Vec3(2.0 * u - 1.0, 4.0 * v, 1.0 - std::abs(2.0 * u - 1.0)); };
  const MeshTarget target(shapes::grid(20, 20, roof), {});
  const Footpoint ridge = target.closest(Vec3(0.0, 2.0, 2.0));
  EXPECT_EQ(ridge.location, Location::kBorder);
  EXPECT_NEAR(ridge.distance, 1.0, 1e-9);
  const Footpoint slope = target.closest(Vec3(1.0, 2.0, 1.0));
  EXPECT_EQ(slope.location, Location::kInside);
  EXPECT_NEAR(slope.distance, std::sqrt(0.5), 1e-9);
}

TEST(MeshTarget, SamplesShareTheAreaOut) {
  const MeshTarget target(shapes::twisted(50), {});
  for (double spacing : {6.0, 2.0, 0.7, 0.35}) {
    const auto samples = target.samples(spacing);
    double sum = 0.0, largest = 0.0;
    for (const SurfaceSample& s : samples) {
      sum += s.area;
      largest = std::max(largest, s.area);
      EXPECT_NEAR(s.normal.norm(), 1.0, 1e-12);
    }
    EXPECT_NEAR(sum / target.area(), 1.0, 1e-12);
    EXPECT_LT(largest, 2.0 * spacing * spacing);
    EXPECT_NEAR(static_cast<double>(samples.size()) * spacing * spacing / target.area(), 1.0, 0.5);
  }
  EXPECT_THROW((void)target.samples(0.0), UsageError);
}

TEST(MeshTarget, SamplesKeepTheTwoSidesOfAThinPartApart) {
  TriangleMesh plate = shapes::saddle(10, 1e9, 20), back = plate;
  for (auto& t : back.triangles) {
    std::swap(t[1], t[2]);
    for (int& v : t) v += static_cast<int>(plate.vertices.size());
  }
  for (Vec3& x : back.vertices) x[2] -= 0.3;
  plate.vertices.insert(plate.vertices.end(), back.vertices.begin(), back.vertices.end());
  plate.triangles.insert(plate.triangles.end(), back.triangles.begin(), back.triangles.end());
  double up = 0.0, down = 0.0;
  for (const SurfaceSample& s : MeshTarget(plate, {}).samples(3.0)) (s.normal[2] > 0.0 ? up : down) += s.area;
  EXPECT_NEAR(up, 400.0, 1e-6);
  EXPECT_NEAR(down, 400.0, 1e-6);
}

TEST(MeshTarget, TakesDamagedMeshes) {
  TriangleMesh mesh = shapes::twisted(30);
  std::swap(mesh.triangles[100][0], mesh.triangles[100][1]);
  mesh.vertices.emplace_back(500, 0, 0);
  mesh.triangles.push_back({7, 7, 8});
  const MeshTarget target(mesh, {});
  EXPECT_EQ(target.patch_count(), 1800);
  EXPECT_LT(target.diagonal(), 100.0);
  EXPECT_NEAR(target.closest(shapes::twisted_point(0.5, 0.5) + twisted_normal(0.5, 0.5)).distance, 1.0, 1e-5);
  EXPECT_THROW(MeshTarget({}, {}), InputError);
  TriangleMesh one;
  one.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  one.triangles = {{0, 1, 2}};
  EXPECT_NEAR(MeshTarget(one, {}).closest(Vec3(0.2, 0.2, 3.0)).distance, 3.0, 1e-12);
}

TEST(MeshQuality, TellsNoiseFromShape) {
  const TriangleMesh smooth = shapes::twisted(60);
  const double diagonal = smooth.box().diagonal();
  EXPECT_FALSE(estimate_noise(smooth).noisy);
  EXPECT_LT(estimate_noise(smooth).noise_relative, 1e-8);
  EXPECT_FALSE(estimate_noise(shapes::torus(20, 8, 30, 16)).noisy);  // coarse, but exact
  for (const double noise : kSide > 100 ? std::vector{1e-5, 1e-4} : std::vector{1e-4}) {
    TriangleMesh rough = smooth;
    shapes::shake(rough, noise * diagonal, 9);
    const MeshQuality quality = estimate_noise(rough);
    EXPECT_TRUE(quality.noisy);
    EXPECT_NEAR(quality.noise_relative, noise, 0.15 * noise);
  }
}

}  // namespace
}  // namespace flank::internal
