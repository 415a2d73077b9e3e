#include "flank/verify/clearance/triangle_gap.h"

#include <gtest/gtest.h>

#include "verify/clearance/clearance_fixture.h"

namespace flank::internal::verify {
namespace {

const Revolved kCylinder({{0.0, 4.0}, {30.0, 4.0}});
const Revolved kCone({{10.0, 2.0}, {40.0, 9.0}});

TEST(TriangleGap, CylinderAbovePlane) {
  // Lying across the z axis of the body: a plane x = 7 beside the cylinder, and one below its end.
  EXPECT_NEAR(triangle_gap(kCylinder, {Vec3(7, -50, -50), Vec3(7, 50, -50), Vec3(7, 0, 90)}).value, 3.0, 1e-9);
  EXPECT_NEAR(triangle_gap(kCylinder, {Vec3(-50, -50, -2), Vec3(50, -50, -2), Vec3(0, 90, -2)}).value, 2.0, 1e-9);
  // Tilted by 45 degrees below the lower rim: the rim's lowest point decides.
  const double gap = (std::sqrt(2.0) * 10.0 - 4.0) / std::sqrt(2.0) + 0.0;
  const double d = 10.0 * std::sqrt(2.0);  // plane x + z = -d sqrt(2) ... at distance d from the origin
  const Vec3 n = Vec3(1, 0, 1).normalized(), foot = -d * n, e(0, 1, 0), f = n.cross(e);
  const TriangleGap tilted = triangle_gap(kCylinder, {foot - 80 * e - 80 * f, foot + 80 * e - 80 * f, foot + 80 * f});
  EXPECT_NEAR(tilted.value, d - 4.0 / std::sqrt(2.0), 1e-9);
  EXPECT_GT(gap, 0.0);
  EXPECT_NEAR(tilted.normal.dot(n), -1.0, 1e-9);
}

TEST(TriangleGap, ConeNearAPoint) {
  // A triangle without area: the point (rho, z) = (20, 25), abreast of the cone's side.
  const double slope = 7.0 / 30.0, expected = (20.0 - (2.0 + slope * 15.0)) / std::sqrt(1.0 + slope * slope);
  const Vec3 p(12, 16, 25);
  EXPECT_NEAR(triangle_gap(kCone, {p, p, p}).value, expected, 1e-9);
  const Vec3 on_axis(0, 0, 3);
  EXPECT_NEAR(triangle_gap(kCone, {on_axis, on_axis, on_axis}).value, 7.0, 1e-9);
  // The axis of the body lies 2 deep in the narrow end.
  const Vec3 inside(0, 0, 20);
  EXPECT_NEAR(triangle_gap(kCone, {inside, inside, inside}).value,
              -(2.0 + slope * 10.0) / std::sqrt(1.0 + slope * slope), 1e-9);
}

TEST(TriangleGap, BodyThatPokesThroughATriangle) {
  // The plane z = 12 across the cylinder: depth 4 to its side at the axis.
  EXPECT_NEAR(triangle_gap(kCylinder, {Vec3(-50, -50, 12), Vec3(50, -50, 12), Vec3(0, 90, 12)}).value, -4.0, 1e-7);
  EXPECT_NEAR(triangle_gap(kCylinder, {Vec3(-50, -50, 1), Vec3(50, -50, 1), Vec3(0, 90, 1)}).value, -1.0, 1e-7);
  // The plane cuts the cylinder, the triangle is beside it.
  EXPECT_NEAR(triangle_gap(kCylinder, {Vec3(9, -1, 12), Vec3(9, 1, 12), Vec3(12, 0, 12)}).value, 5.0, 1e-9);
}

TEST(LeastOfLarger, IsTheLeastOfTheLargerOfTwoPlanesOnATriangle) {
  Random random(8);
  for (int i = 0; i < 300; ++i) {
    std::array<double, 3> a, b;
    for (std::size_t k = 0; k < 3; ++k) a[k] = random.uniform(-1.0, 1.0), b[k] = random.uniform(-1.0, 1.0);
    constexpr int kSteps = 60;
    double least = 1e300;
    for (int p = 0; p <= kSteps; ++p) {
      for (int q = 0; p + q <= kSteps; ++q) {
        const double u = static_cast<double>(p) / kSteps, v = static_cast<double>(q) / kSteps, w = 1.0 - u - v;
        least = std::min(least, std::max(u * a[0] + v * a[1] + w * a[2], u * b[0] + v * b[1] + w * b[2]));
      }
    }
    const double found = least_of_larger(a, b);
    ASSERT_LE(found, least + 1e-12) << i << ": a bound from below";
    ASSERT_GE(found, least - 2.0 * 2.0 / kSteps) << i << ": as high as it can be, but for the steps of the grid";
  }
}

TEST(FacingNormals, AreOfTheTwoNearestSidesWithinTheBody) {
  // Nearer to the lower end than to the wall, and no third side is as near.
  const std::array<Vec3, 2> normals = facing_normals(kCylinder, Vec3(0.0, 3.5, 0.2));
  EXPECT_LT((normals[0] - Vec3(0, 0, -1)).norm(), 1e-15);
  EXPECT_LT((normals[1] - Vec3(0, 1, 0)).norm(), 1e-15);
  const Revolved ball({{5.0, 0.0}}, 3.0);
  EXPECT_LT((facing_normals(ball, Vec3(1, 0, 5))[1] - Vec3(1, 0, 0)).norm(), 1e-15) << "its gradient";
}

TEST(TriangleGap, AgreesWithBruteForce) {
  Random random(7);
  const std::vector<std::vector<Vec2>> profiles = {
      {{0, 4}, {30, 4}}, {{10, 2}, {40, 9}}, {{10, 9}, {40, 0}}, {{0, 3}, {5, 6}, {20, 8}, {30, 8}, {34, 2}}, {{5, 7}}};
  for (const auto& profile : profiles) {
    const Revolved body(profile);
    for (int k = 0; k < 300; ++k) {
      const double size = k % 3 == 0 ? 30.0 : k % 3 == 1 ? 5.0 : 60.0;
      const Vec3 middle = random_point(random, 25.0) + Vec3(0, 0, 15);
      std::array<Vec3, 3> v;
      for (Vec3& x : v) x = middle + random_point(random, size);
      const double brute =
          brute_triangle(v, [&](const Vec3& x) { return profile_distance(profile, x.z(), std::hypot(x.x(), x.y())); });
      const TriangleGap gap = triangle_gap(body, v);
      ASSERT_NEAR(gap.value, brute, 1e-6) << k;
      ASSERT_NEAR(profile_distance(profile, gap.point.z(), std::hypot(gap.point.x(), gap.point.y())), gap.value, 1e-6);
      ASSERT_NEAR(gap.normal.norm(), 1.0, 1e-9);
      ASSERT_GE(triangle_gap(body, v, gap.value - 0.1).value, gap.value - 0.1);
      ASSERT_NEAR(triangle_gap(body, v, gap.value + 0.1).value, gap.value, 1e-6);
    }
  }
}

TEST(Revolved, UnionOfConvexBodies) {
  EXPECT_TRUE(convex_bodies({}).empty());
  EXPECT_EQ(convex_bodies({{0, 4}, {30, 4}, {30, 10}, {60, 10}}).size(), 2u);
  EXPECT_EQ(convex_bodies({{0, 4}, {10, 6}, {20, 7}}).size(), 1u);
  EXPECT_EQ(convex_bodies({{0, 4}, {10, 4.5}, {20, 7}}).size(), 2u);
  EXPECT_EQ(convex_bodies({{30, 0}, {30, 10}}).size(), 1u);
}

}  // namespace
}  // namespace flank::internal::verify
