#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "flank/base/random.h"
#include "flank/error.h"
#include "flank/judge.h"
#include "flank/verify/sample_mesh.h"

namespace flank::internal {
namespace {

TriangleMesh random_mesh(std::uint64_t seed, int count) {
  Random random(seed);
  TriangleMesh mesh;
  for (int i = 0; i < count; ++i) {
    for (int k = 0; k < 3; ++k)
      mesh.vertices.emplace_back(random.uniform(-5, 5), random.uniform(-5, 5), random.uniform(-5, 5));
    mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return mesh;
}

double area(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles) {
    const Vec3& a = mesh.vertices[static_cast<std::size_t>(t[0])];
    sum += 0.5 * (mesh.vertices[static_cast<std::size_t>(t[1])] - a)
                     .cross(mesh.vertices[static_cast<std::size_t>(t[2])] - a)
                     .norm();
  }
  return sum;
}

TEST(SampleMesh, AreasAddUpAndMomentsAreThoseOfTheTriangles) {
  const TriangleMesh mesh = random_mesh(1, 20);
  for (const double spacing : {50.0, 1.0, 0.3}) {
    const FaceSamples s = sample_mesh("F1", mesh, spacing, true);
    EXPECT_NEAR(std::accumulate(s.areas.begin(), s.areas.end(), 0.0), area(mesh), 1e-9);
    // Centroids with their areas have the triangles' own centre of area, exactly.
    Vec3 sum = Vec3::Zero(), wanted = Vec3::Zero();
    for (std::size_t i = 0; i < s.points.size(); ++i) sum += s.areas[i] * s.points[i];
    for (const auto& t : mesh.triangles) {
      const TriangleMesh one{
          {mesh.vertices[static_cast<std::size_t>(t[0])], mesh.vertices[static_cast<std::size_t>(t[1])],
           mesh.vertices[static_cast<std::size_t>(t[2])]},
          {{0, 1, 2}}};
      wanted += area(one) * (one.vertices[0] + one.vertices[1] + one.vertices[2]) / 3.0;
    }
    EXPECT_LT((sum - wanted).norm(), 1e-8);
  }
}

TEST(SampleMesh, ATriangleIsCutIntoSquaresOfWholeNumbers) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {3, 0, 0}, {0, 4, 0}};
  mesh.triangles = {{0, 1, 2}};
  for (const auto& [spacing, count] :
       {std::pair(6.0, 1u), std::pair(5.0, 1u), std::pair(2.5, 4u), std::pair(1.0, 25u)}) {
    const FaceSamples s = sample_mesh("F1", mesh, spacing, false);
    EXPECT_EQ(s.points.size(), count);
    for (const Vec3& n : s.normals) EXPECT_EQ(n, Vec3(0, 0, 1)) << "counter-clockwise seen from the machining side";
    EXPECT_LT(s.spacing_mm, spacing);
    EXPECT_FALSE(s.target);
  }
  for (const auto& triangle : {std::array{0, 1, 2}, std::array{1, 2, 0}, std::array{2, 0, 1}}) {
    mesh.triangles = {triangle};
    const FaceSamples one = sample_mesh("F1", mesh, 6.0, false);
    EXPECT_LT((one.points[0] - Vec3(1, 4.0 / 3.0, 0)).norm(), 1e-15);
    EXPECT_NEAR(one.spacing_mm, Vec2(1, 4.0 / 3.0 - 4.0).norm(), 1e-15) << "to the farthest corner, whichever it is";
  }
}

TEST(SampleMesh, PartsOfCellsTileThem) {
  const TriangleMesh mesh = random_mesh(3, 4);
  const auto sampler = verify::make_sampler("F1", mesh, 1.5, true, 1 << 16);
  const FaceSamples all = sampler->tile(0);
  for (std::size_t i = 0; i < all.points.size(); ++i) {
    const FaceSamples parts = sampler->cut(all, std::array{i});
    ASSERT_EQ(parts.points.size(), 16u);
    EXPECT_NEAR(std::accumulate(parts.areas.begin(), parts.areas.end(), 0.0), all.areas[i], 1e-12);
    Vec3 middle = Vec3::Zero();
    for (const Vec3& p : parts.points) middle += p / 16.0;
    EXPECT_LT((middle - all.points[i]).norm(), 1e-12);
    EXPECT_EQ(parts.normals[5], all.normals[i]);
    EXPECT_LE(parts.spacing_mm, 0.25 * all.spacing_mm + 1e-12);
  }
}

TEST(SampleMesh, NoPointIsFartherFromASampleThanTheSpacingItStates) {
  const TriangleMesh mesh = random_mesh(2, 5);
  const FaceSamples s = sample_mesh("F1", mesh, 1.2, true);
  Random random(2);
  for (int i = 0; i < 500; ++i) {
    const auto& t = mesh.triangles[random.next() % 5];
    const double a = std::sqrt(random.uniform()), b = random.uniform();
    const Vec3 x = (1 - a) * mesh.vertices[static_cast<std::size_t>(t[0])] +
                   a * (1 - b) * mesh.vertices[static_cast<std::size_t>(t[1])] +
                   a * b * mesh.vertices[static_cast<std::size_t>(t[2])];
    double nearest = 1e300;
    for (const Vec3& p : s.points) nearest = std::min(nearest, (p - x).norm());
    ASSERT_LE(nearest, s.spacing_mm + 1e-12);
  }
}

TEST(SampleMesh, TurningTheMeshTurnsItsSamples) {
  const TriangleMesh mesh = random_mesh(3, 8);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.8, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  TriangleMesh moved = mesh;
  for (Vec3& v : moved.vertices) v = turn * v + Vec3(7, 8, 9);
  const FaceSamples a = sample_mesh("F1", mesh, 0.9, true), b = sample_mesh("F1", moved, 0.9, true);
  ASSERT_EQ(a.points.size(), b.points.size());
  for (std::size_t i = 0; i < a.points.size(); ++i) {
    ASSERT_LT((turn * a.points[i] + Vec3(7, 8, 9) - b.points[i]).norm(), 1e-12);
    ASSERT_LT((turn * a.normals[i] - b.normals[i]).norm(), 1e-12);
    ASSERT_NEAR(a.areas[i], b.areas[i], 1e-12);
  }
}

TEST(SampleMesh, TrianglesWithoutAreaHaveSamplesWithoutAreaAndNormal) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 0, 0}};
  const FaceSamples s = sample_mesh("F1", mesh, 10.0, true);
  ASSERT_EQ(s.points.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(s.areas[i], 0.0);
    EXPECT_EQ(s.normals[i], Vec3::Zero().eval());
    EXPECT_TRUE(s.points[i].allFinite());
  }
}

TEST(SampleMesh, RefusesWhatIsNoSpacingAndNoMesh) {
  TriangleMesh mesh = random_mesh(4, 2);
  for (const double spacing : {0.0, -1.0, std::nan("")})
    EXPECT_THROW((void)sample_mesh("F3", mesh, spacing, true), UsageError) << spacing;
  mesh.vertices[4].y() = std::nan("");
  try {
    (void)sample_mesh("F3", mesh, 1.0, true);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("F3"), std::string::npos);
  }
  EXPECT_TRUE(sample_mesh("F3", TriangleMesh(), 1.0, true).points.empty());
}

Vec3 corner(const TriangleMesh& mesh, std::size_t t, std::size_t k) {
  return mesh.vertices[static_cast<std::size_t>(mesh.triangles[t][k])];
}

Vec3 area_vector(const TriangleMesh& mesh, std::size_t t) {
  const Vec3 a = corner(mesh, t, 0);
  return 0.5 * (corner(mesh, t, 1) - a).cross(corner(mesh, t, 2) - a);
}

TriangleMesh one(const Vec3& a, const Vec3& b, const Vec3& c) { return {{a, b, c}, {{0, 1, 2}}}; }

TEST(SliverSlices, KeepAreaAndSideWhereverTheLongestSideIs) {
  Random random(3);
  for (int k = 0; k < 200; ++k) {
    const double width = random.uniform(0.001, 3.0), top = random.uniform(-0.5, 1.5);
    std::array<Vec3, 3> corners{Vec3(0, 0, 0), Vec3(10, 0, 0), Vec3(10 * top, width, 0)};
    std::rotate(corners.begin(), corners.begin() + k % 3, corners.end());
    const auto whole = one(corners[0], corners[1], corners[2]);
    const auto sliced = verify::with_slivers_sliced(whole, 0.3);
    Vec3 sum = Vec3::Zero(), middle = Vec3::Zero();
    for (std::size_t t = 0; t < sliced.triangles.size(); ++t) {
      const auto own = area_vector(sliced, t);
      EXPECT_GT(own.z(), 0.0);
      sum += own;
      middle += own.z() * (corner(sliced, t, 0) + corner(sliced, t, 1) + corner(sliced, t, 2)) / 3.0;
    }
    const auto wanted = area_vector(whole, 0);
    EXPECT_LT((sum - wanted).norm(), 1e-12);
    EXPECT_LT((middle / wanted.z() - (corners[0] + corners[1] + corners[2]) / 3.0).norm(), 1e-9);
  }
}

TEST(SliverSlices, ASliverIsSampledAsOftenAsItIsLong) {
  const auto needle = one({0, 0, 0}, {10, 0, 0}, {10, 0.01, 0}), cap = one({0, 0, 0}, {10, 0, 0}, {5, 0.01, 0});
  for (const auto& mesh : {needle, cap}) {
    EXPECT_GE(sample_mesh("F1", mesh, 0.1, true).points.size(), 10000u);
    const auto samples = sample_mesh("F1", verify::with_slivers_sliced(mesh, 0.1), 0.1, true);
    EXPECT_LT(samples.points.size(), 260u);
    EXPECT_LT(samples.spacing_mm, 0.1);
  }
}

TEST(SliverSlices, OtherTrianglesStayAsTheyAre) {
  const auto wide = one({0, 0, 0}, {10, 0, 0}, {4, 8, 0}), small = one({0, 0, 0}, {0.1, 0, 0}, {0.1, 0.001, 0});
  const auto flat = one({0, 0, 0}, {10, 0, 0}, {5, 0, 0});
  for (const auto& mesh : {wide, small, flat}) {
    const auto sliced = verify::with_slivers_sliced(mesh, 0.1);
    EXPECT_EQ(sliced.triangles, mesh.triangles);
    EXPECT_EQ(sliced.vertices.size(), mesh.vertices.size());
  }
}

}  // namespace
}  // namespace flank::internal
