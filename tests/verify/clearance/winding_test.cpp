#include "flank/verify/clearance/winding.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "flank/base/random.h"
#include "verify/clearance/clearance_fixture.h"

namespace flank::internal::verify {
namespace {

/// Good to about this much, says the header.
constexpr double kGoodTo = 0.05;

/// A sphere by rings, oriented outwards; `until` < rings leaves its lower part open.
TriangleMesh sphere(double radius, int rings, int until) {
  TriangleMesh mesh;
  const int around = 2 * rings;
  for (int i = 0; i <= until; ++i) {
    const double a = std::numbers::pi * i / rings;
    for (int k = 0; k < around; ++k) {
      const double b = 2.0 * std::numbers::pi * k / around;
      mesh.vertices.push_back(radius * Vec3(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a)));
    }
  }
  for (int i = 0; i < until; ++i) {
    for (int k = 0; k < around; ++k) {
      const int a = i * around + k, b = i * around + (k + 1) % around;
      mesh.triangles.push_back({a, a + around, b});
      mesh.triangles.push_back({b, a + around, b + around});
    }
  }
  return mesh;
}

void add(TriangleMesh& to, const TriangleMesh& other, const Vec3& shift) {
  const int base = static_cast<int>(to.vertices.size());
  for (const Vec3& v : other.vertices) to.vertices.push_back(v + shift);
  for (const auto& t : other.triangles) to.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
}

void turn_inside_out(TriangleMesh& mesh) {
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
}

/// The share of the sphere of directions that a triangle takes up, by its angles: not by the formula of the source.
double brute_number(const TriangleMesh& mesh, const Vec3& x) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles) {
    std::array<Vec3, 3> v;
    for (std::size_t k = 0; k < 3; ++k) v[k] = (mesh.vertices[static_cast<std::size_t>(t[k])] - x).normalized();
    if ((v[1] - v[0]).cross(v[2] - v[0]).norm() < 1e-12) continue;  // at the poles
    double excess = -std::numbers::pi;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 &a = v[k], &b = v[(k + 1) % 3], &c = v[(k + 2) % 3];
      const Vec3 p = b - b.dot(a) * a, q = c - c.dot(a) * a;
      excess += std::acos(std::clamp(p.normalized().dot(q.normalized()), -1.0, 1.0));
    }
    sum += (v[0].dot(v[1].cross(v[2])) < 0.0 ? -excess : excess) / (4.0 * std::numbers::pi);
  }
  return sum;
}

TEST(Winding, OfASphereIsOneInsideAndNothingOutside) {
  const TriangleMesh mesh = sphere(10.0, 24, 24);
  const Winding winding(mesh);
  Random random(1);
  for (int i = 0; i < 500; ++i) {
    const Vec3 x = random_unit(random) * random.uniform(0.0, 30.0);
    if (std::abs(x.norm() - 9.95) < 0.3) continue;
    ASSERT_NEAR(winding.number(x), x.norm() < 10.0 ? 1.0 : 0.0, kGoodTo) << x.transpose();
    ASSERT_EQ(winding.inside(x), x.norm() < 10.0);
  }
}

TEST(Winding, InsideOutItIsMinusOneAndStillInside) {
  TriangleMesh mesh = sphere(10.0, 24, 24);
  turn_inside_out(mesh);
  const Winding winding(mesh);
  EXPECT_NEAR(winding.number({1, 2, 3}), -1.0, kGoodTo);
  EXPECT_TRUE(winding.inside({1, 2, 3}));
  EXPECT_FALSE(winding.inside({10, 2, 3}));
}

TEST(Winding, AgreesWithTheSumOverAllTriangles) {
  Random random(2);
  TriangleMesh mesh = sphere(10.0, 16, 13);  // open below
  add(mesh, sphere(4.0, 10, 10), {3, 2, 1});
  add(mesh, sphere(5.0, 10, 10), {60, 0, 0});
  const Winding winding(mesh);
  for (int i = 0; i < 300; ++i) {
    const Vec3 x = random_point(random, i % 2 == 0 ? 15.0 : 80.0);
    ASSERT_NEAR(winding.number(x), brute_number(mesh, x), kGoodTo) << x.transpose();
  }
}

TEST(Winding, AnOpenHemisphereHasItsShareOfTheDirections) {
  // From the middle of the rim a hemisphere is half of all directions; a cap of 60 degrees is (1 - cos) / 2.
  const Winding half(sphere(10.0, 60, 30)), cap(sphere(10.0, 60, 20));
  EXPECT_NEAR(half.number(Vec3::Zero()), 0.5, 0.01);
  EXPECT_NEAR(cap.number(Vec3::Zero()), 0.25, 0.01);
}

TEST(Winding, AGapAsThinAsATriangulationErrorChangesLittle) {
  TriangleMesh mesh = sphere(10.0, 24, 24);
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 2) {
    // The triangle gets corners of its own, a little off the others'.
    for (int& v : mesh.triangles[i]) {
      mesh.vertices.push_back(mesh.vertices[static_cast<std::size_t>(v)] + Vec3(0.01, -0.01, 0.005));
      v = static_cast<int>(mesh.vertices.size()) - 1;
    }
  }
  const Winding winding(mesh);
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    const Vec3 x = random_unit(random) * random.uniform(0.0, 20.0);
    if (std::abs(x.norm() - 9.95) < 0.5) continue;
    ASSERT_EQ(winding.inside(x), x.norm() < 10.0) << x.transpose();
  }
}

TEST(Winding, ACavityIsOutside) {
  TriangleMesh mesh = sphere(10.0, 24, 24), hollow = sphere(5.0, 24, 24);
  turn_inside_out(hollow);
  add(mesh, hollow, Vec3::Zero());
  const Winding winding(mesh);
  EXPECT_FALSE(winding.inside({1, 1, 1}));
  EXPECT_TRUE(winding.inside({0, 0, 7.5}));
  EXPECT_FALSE(winding.inside({0, 0, 12.0}));
}

TEST(Winding, OfNoTrianglesOrOfOnesWithoutAreaIsZero) {
  EXPECT_EQ(Winding(TriangleMesh()).number({1, 2, 3}), 0.0);
  TriangleMesh flat;
  flat.vertices = {{0, 0, 0}, {1, 0, 0}};
  flat.triangles = {{0, 1, 1}, {0, 0, 0}};
  for (const Vec3& x : {Vec3(0.5, 3, 0), Vec3(0.5, 0.1, 0), Vec3(100, 0, 0)})
    EXPECT_NEAR(Winding(flat).number(x), 0.0, 1e-12);
}

}  // namespace
}  // namespace flank::internal::verify
