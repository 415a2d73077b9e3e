#include "flank/io/mesh/read_mesh_regions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>

namespace flank::internal {
namespace {

/// A sheet of nu x nv cells through the points of a function of [0, 1]^2.
TriangleMesh sheet(int nu, int nv, const std::function<Vec3(double, double)>& at) {
  TriangleMesh mesh;
  for (int i = 0; i <= nu; ++i)
    for (int j = 0; j <= nv; ++j) mesh.vertices.push_back(at(static_cast<double>(i) / nu, static_cast<double>(j) / nv));
  for (int i = 0; i < nu; ++i) {
    for (int j = 0; j < nv; ++j) {
      const int a = i * (nv + 1) + j, b = a + nv + 1;
      mesh.triangles.push_back({a, b, b + 1});
      mesh.triangles.push_back({a, b + 1, a + 1});
    }
  }
  return mesh;
}

/// Two squares of 10 mm that meet at a line, the second turned up by an angle, the first `share` of the whole.
TriangleMesh bent(double degrees, double share = 0.5, int n = 40) {
  const double a = degrees * std::numbers::pi / 180.0;
  return sheet(n, 20, [=](double u, double v) {
    const double s = 20.0 * (u - share);
    return s <= 0.0 ? Vec3(s, 10.0 * v, 0.0) : Vec3(s * std::cos(a), 10.0 * v, s * std::sin(a));
  });
}

double area(const TriangleMesh& mesh, const std::vector<int>& triangles) {
  double sum = 0.0;
  for (const int k : triangles) {
    const auto& t = mesh.triangles[static_cast<std::size_t>(k)];
    const Vec3& a = mesh.vertices[static_cast<std::size_t>(t[0])];
    sum += 0.5 * (mesh.vertices[static_cast<std::size_t>(t[1])] - a)
                     .cross(mesh.vertices[static_cast<std::size_t>(t[2])] - a)
                     .norm();
  }
  return sum;
}

/// Every triangle in one region, regions by falling area, triangles ascending.
void expect_partition(const TriangleMesh& mesh, const std::vector<std::vector<int>>& regions) {
  std::set<int> seen;
  double before = 1e300;
  for (const auto& region : regions) {
    EXPECT_TRUE(std::is_sorted(region.begin(), region.end()));
    for (const int t : region) EXPECT_TRUE(seen.insert(t).second) << t;
    EXPECT_LE(area(mesh, region), before + 1e-9);
    before = area(mesh, region);
  }
  EXPECT_EQ(seen.size(), mesh.triangles.size());
}

TEST(ReadMeshRegions, ATurnBelowTheSharpAngleIsNoEdgeAndOneAboveIsOne) {
  for (const auto& [degrees, count] :
       {std::pair(0.0, 1u), std::pair(30.0, 1u), std::pair(60.0, 2u), std::pair(90.0, 2u), std::pair(150.0, 2u)}) {
    const TriangleMesh mesh = bent(degrees);
    const auto regions = mesh_regions(mesh);
    EXPECT_EQ(regions.size(), count) << degrees;
    expect_partition(mesh, regions);
    if (count == 2u) {
      EXPECT_NEAR(area(mesh, regions[0]), 100.0, 1e-9) << "cut at the line itself";
    }
  }
}

TEST(ReadMeshRegions, TheSharpAngleIsTheOneAskedFor) {
  RegionOptions options;
  options.sharp_rad = 0.3;
  EXPECT_EQ(mesh_regions(bent(30.0), options).size(), 2u);
  options.sharp_rad = 1.2;
  EXPECT_EQ(mesh_regions(bent(60.0), options).size(), 1u);
}

TEST(ReadMeshRegions, RegionsComeByArea) {
  const TriangleMesh mesh = bent(90.0, 0.3);
  const auto regions = mesh_regions(mesh);
  ASSERT_EQ(regions.size(), 2u);
  EXPECT_NEAR(area(mesh, regions[0]), 140.0, 1e-9);
  EXPECT_NEAR(area(mesh, regions[1]), 60.0, 1e-9);
  EXPECT_GT(regions[0].front(), regions[1].front()) << "though the smaller one comes first in the file";
}

TEST(ReadMeshRegions, ARegionTooSmallJoinsTheNeighbourOfTheLongestBorder) {
  const TriangleMesh mesh = bent(90.0, 0.05);
  RegionOptions options;
  ASSERT_EQ(mesh_regions(mesh, options).size(), 2u);
  options.least_area_share = 0.1;
  EXPECT_EQ(mesh_regions(mesh, options).size(), 1u) << "a twentieth of the area is too little now";
}

TEST(ReadMeshRegions, AWholeCylinderIsOneFaceHoweverMuchItTurns) {
  const TriangleMesh mesh = sheet(90, 30, [](double u, double v) {
    const double a = 1.9 * std::numbers::pi * u;
    return Vec3(10.0 * std::cos(a), 10.0 * std::sin(a), 30.0 * v);
  });
  EXPECT_EQ(mesh_regions(mesh).size(), 1u);
}

/// The skin of an ellipse of 60 mm chord, 120 mm long, twisted by half a radian, on a plate.
TriangleMesh skin_on_a_plate(double thickness, int round, int along) {
  TriangleMesh mesh = sheet(round, along, [&](double u, double v) {
    const double a = 2.0 * std::numbers::pi * u, turn = 0.5 * v;
    const double x = 30.0 * std::cos(a), y = 0.5 * thickness * std::sin(a);
    return Vec3(std::cos(turn) * x - std::sin(turn) * y, std::sin(turn) * x + std::cos(turn) * y, 120.0 * v);
  });
  // The seam: the last row of points is the first one.
  const int last = round * (along + 1);
  for (auto& t : mesh.triangles)
    for (int& v : t)
      if (v >= last) v -= last;
  mesh.vertices.resize(static_cast<std::size_t>(last));
  const int base = static_cast<int>(mesh.vertices.size());
  for (const Vec3& p : {Vec3(-60, -40, 0), Vec3(60, -40, 0), Vec3(60, 40, 0), Vec3(-60, 40, 0)})
    mesh.vertices.push_back(p);
  mesh.triangles.push_back({base, base + 1, base + 2});
  mesh.triangles.push_back({base, base + 2, base + 3});
  return mesh;
}

TEST(ReadMeshRegions, ASkinThatWrapsRoundThickEdgesHasSides) {
  // Radii of 0.8 and 4 mm at the ends of 60: at the second the normal turns over more than the share of the box.
  for (const double thickness : {10.0, 22.0}) {
    for (const int round : {120, 300}) {
      const TriangleMesh mesh = skin_on_a_plate(thickness, round, 60);
      const auto regions = mesh_regions(mesh);
      expect_partition(mesh, regions);
      // The plate is the largest.
      ASSERT_GE(regions.size(), 5u) << thickness << " " << round;
      EXPECT_NEAR(area(mesh, regions[1]) / area(mesh, regions[2]), 1.0, 0.05) << thickness << " " << round;
      EXPECT_GT(area(mesh, regions[2]), 0.7 * 60.0 * 120.0) << thickness << " " << round;
    }
  }
}

TEST(ReadMeshRegions, ASkinOfSliversHasSides) {
  // Triangles as long as the skin, 1 mm wide: their middles are 40 mm apart.
  const TriangleMesh mesh = skin_on_a_plate(8.0, 120, 1);
  const auto regions = mesh_regions(mesh);
  expect_partition(mesh, regions);
  ASSERT_GE(regions.size(), 5u);
  EXPECT_NEAR(area(mesh, regions[1]) / area(mesh, regions[2]), 1.0, 0.1);
  EXPECT_GT(area(mesh, regions[2]), 0.7 * 60.0 * 120.0);
}

TEST(ReadMeshRegions, ASkinWithoutEdgesStaysWhole) {
  for (const double thickness : {40.0, 60.0}) {
    const auto regions = mesh_regions(skin_on_a_plate(thickness, 200, 60));
    EXPECT_EQ(regions.size(), 2u) << thickness;
  }
}

TEST(ReadMeshRegions, SheetsThatDoNotTouchAreFacesOfTheirOwn) {
  TriangleMesh mesh = bent(0.0), other = bent(0.0);
  const int base = static_cast<int>(mesh.vertices.size());
  for (const Vec3& v : other.vertices) mesh.vertices.push_back(v + Vec3(0, 0, 5));
  for (const auto& t : other.triangles) mesh.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
  EXPECT_EQ(mesh_regions(mesh).size(), 2u);
}

TEST(ReadMeshRegions, SizeAndPlaceDoNotMatter) {
  const TriangleMesh mesh = bent(75.0, 0.4);
  const auto wanted = mesh_regions(mesh);
  TriangleMesh moved = mesh;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  for (Vec3& v : moved.vertices) v = 0.01 * (turn * v) + Vec3(3, 2, 1);
  EXPECT_EQ(mesh_regions(moved), wanted);
}

TEST(ReadMeshRegions, NoiseOfTheVerticesIsNoEdge) {
  TriangleMesh mesh = bent(80.0, 0.5, 80);
  double phase = 0.0;
  for (Vec3& v : mesh.vertices) {
    v += 0.02 * Vec3(std::sin(7.1 * phase), std::sin(3.3 * phase + 1.0), std::sin(5.7 * phase + 2.0));
    phase += 1.0;
  }
  const auto regions = mesh_regions(mesh);
  ASSERT_GE(regions.size(), 2u);
  EXPECT_NEAR(area(mesh, regions[0]), 100.0, 6.0);
  EXPECT_NEAR(area(mesh, regions[1]), 100.0, 6.0);
}

}  // namespace
}  // namespace flank::internal
