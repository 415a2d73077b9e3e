#include "flank/io/mesh/read_mesh_repair.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "flank/error.h"

namespace flank::internal {
namespace {

/// The unit cube times `size` about `center`, outwards: 8 corners, 12 triangles.
TriangleMesh cube(double size, const Vec3& center = Vec3::Zero()) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.vertices.push_back(center + size * (Vec3(i & 1, (i >> 1) & 1, (i >> 2) & 1) - Vec3::Constant(0.5)));
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

void add(TriangleMesh& to, const TriangleMesh& other) {
  const int base = static_cast<int>(to.vertices.size());
  to.vertices.insert(to.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const auto& t : other.triangles) to.triangles.push_back({t[0] + base, t[1] + base, t[2] + base});
}

TriangleMesh inside_out(TriangleMesh mesh) {
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

/// Every triangle with corners of its own, as STL has them.
TriangleMesh as_soup(const TriangleMesh& mesh) {
  TriangleMesh soup;
  for (const auto& t : mesh.triangles) {
    const int n = static_cast<int>(soup.vertices.size());
    for (const int v : t) soup.vertices.push_back(mesh.vertices[static_cast<std::size_t>(v)]);
    soup.triangles.push_back({n, n + 1, n + 2});
  }
  return soup;
}

double volume(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles) {
    const auto at = [&](int k) { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
    sum += at(0).dot(at(1).cross(at(2))) / 6.0;
  }
  return sum;
}

bool tells(const ReadMesh& mesh, const std::string& words) {
  return std::any_of(mesh.repairs.begin(), mesh.repairs.end(),
                     [&](const std::string& line) { return line.find(words) != std::string::npos; });
}

TEST(ReadMeshRepair, ASoundMeshIsLeftAloneAndThereIsNothingToTell) {
  const TriangleMesh mesh = cube(4.0);
  const ReadMesh read = repair_read_mesh(mesh, false);
  EXPECT_EQ(read.mesh.vertices, mesh.vertices);
  EXPECT_EQ(read.mesh.triangles, mesh.triangles);
  EXPECT_TRUE(read.repairs.empty()) << read.repairs.front();
}

TEST(ReadMeshRepair, CornersThatTheFormatRepeatsAreWeldedWithoutAWord) {
  const ReadMesh soup = repair_read_mesh(as_soup(cube(4.0)), true);
  EXPECT_EQ(soup.mesh.vertices.size(), 8u);
  EXPECT_TRUE(soup.repairs.empty());
  const ReadMesh file = repair_read_mesh(as_soup(cube(4.0)), false);
  EXPECT_EQ(file.mesh.vertices.size(), 8u);
  EXPECT_TRUE(tells(file, "welded 28 vertices"));
}

TEST(ReadMeshRepair, VerticesAreOneWithinTheShareOfTheBoxAndNoFarther) {
  const double diagonal = 4.0 * std::sqrt(3.0);
  for (const auto& [share, vertices] : {std::pair(0.5, 8u), std::pair(50.0, 36u)}) {
    TriangleMesh soup = as_soup(cube(4.0));
    for (std::size_t i = 0; i < soup.vertices.size(); ++i)
      soup.vertices[i].x() += share * kWeldShare * diagonal * static_cast<double>(i) / 12.0;
    const ReadMesh read = repair_read_mesh(soup, true);
    if (vertices == 8u) {
      EXPECT_LE(read.mesh.vertices.size(), 24u);
    } else {
      EXPECT_GT(read.mesh.vertices.size(), 24u);
      EXPECT_TRUE(tells(read, "holes or open rims"));
    }
  }
}

TEST(ReadMeshRepair, ClosedComponentsAreTurnedOutwardsEachByItself) {
  TriangleMesh mesh = cube(4.0);
  add(mesh, inside_out(cube(2.0, {10, 0, 0})));
  const ReadMesh read = repair_read_mesh(mesh, false);
  EXPECT_NEAR(volume(read.mesh), 64.0 + 8.0, 1e-12);
  EXPECT_TRUE(tells(read, "turned 12 triangles"));
  EXPECT_TRUE(tells(read, "2 components"));
}

TEST(ReadMeshRepair, ACavityStaysACavity) {
  TriangleMesh mesh = cube(4.0);
  add(mesh, inside_out(cube(2.0)));
  const ReadMesh read = repair_read_mesh(mesh, false);
  EXPECT_NEAR(volume(read.mesh), 64.0 - 8.0, 1e-12);
  EXPECT_FALSE(tells(read, "turned"));
}

TEST(ReadMeshRepair, AnOpenSheetIsNotTurned) {
  TriangleMesh mesh = cube(4.0);
  mesh.triangles.resize(2);
  const ReadMesh there = repair_read_mesh(mesh, false), back = repair_read_mesh(inside_out(mesh), false);
  EXPECT_EQ(there.mesh.triangles.size(), 2u);
  EXPECT_EQ(there.mesh.vertices.size(), 4u) << "vertices of no triangle are gone";
  EXPECT_NE(there.mesh.triangles, back.mesh.triangles);
  EXPECT_TRUE(tells(there, "left 1 holes or open rims (the largest 5.66 mm across)"));
}

TEST(ReadMeshRepair, FinsAreRemovedAndWallsAreNot) {
  const double sizes[] = {0.3, 3.0};
  for (const double size : sizes) {
    TriangleMesh mesh = cube(4.0);
    // A triangle on an edge that two others share already.
    mesh.vertices.emplace_back(0.0, -2.0 - size, -2.0 - size);
    mesh.triangles.push_back({0, 1, 8});
    const ReadMesh read = repair_read_mesh(mesh, false);
    const double area = 0.5 * 4.0 * std::sqrt(2.0) * size;
    const bool fin = area < kFinAreaShare * (96.0 + area);
    EXPECT_EQ(fin, size == 0.3);
    EXPECT_EQ(read.mesh.triangles.size(), fin ? 12u : 13u);
    EXPECT_EQ(tells(read, "removed 1 triangles of fins"), fin);
    EXPECT_EQ(tells(read, "left 1 non-manifold edges"), !fin);
    if (fin) {
      EXPECT_EQ(read.mesh.vertices.size(), 8u) << "its corner goes with it";
    }
  }
}

TEST(ReadMeshRepair, HolesAreCountedEachWithItsRim) {
  TriangleMesh mesh = cube(4.0);
  mesh.triangles.erase(mesh.triangles.begin() + 2, mesh.triangles.begin() + 4);  // the whole top
  mesh.triangles.erase(mesh.triangles.begin());                                  // half the bottom
  const ReadMesh read = repair_read_mesh(mesh, false);
  EXPECT_EQ(read.mesh.triangles.size(), 9u);
  EXPECT_TRUE(tells(read, "left 2 holes or open rims (the largest 5.66 mm across)"));
}

TEST(ReadMeshRepair, FoldsAreTold) {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {4, 0, 0}, {2, 3, 0}, {2, 3.1, 0.001}};
  mesh.triangles = {{0, 1, 2}, {1, 0, 3}};
  EXPECT_TRUE(tells(repair_read_mesh(mesh, false), "left 1 edges at which the surface folds back"));
}

TEST(ReadMeshRepair, WhatCannotBeMendedIsRefused) {
  EXPECT_THROW((void)repair_read_mesh(TriangleMesh(), true), InputError);
  TriangleMesh flat;
  flat.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  flat.triangles = {{0, 1, 2}};
  EXPECT_THROW((void)repair_read_mesh(flat, true), InputError);
}

}  // namespace
}  // namespace flank::internal
