#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <set>

#include "flank/io/mesh/read_mesh_regions.h"
#include "flank/io/mesh/write_mesh.h"
#include "io/part_files.h"

namespace flank::internal {
namespace {

using testing_io::Scratch;
using testing_io::tells;

/// Box of 2 x 3 x 4, each side cut into n x n x 2 triangles, outward.
TriangleMesh box_mesh(int n) {
  TriangleMesh mesh;
  const Vec3 size(2.0, 3.0, 4.0);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double end : {0.0, 1.0}) {
      const int base = static_cast<int>(mesh.vertices.size());
      for (int i = 0; i <= n; ++i) {
        for (int j = 0; j <= n; ++j) {
          Vec3 p;
          p[axis] = end, p[(axis + 1) % 3] = double(i) / n, p[(axis + 2) % 3] = double(j) / n;
          mesh.vertices.push_back(p.cwiseProduct(size));
        }
      }
      for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
          const int a = base + i * (n + 1) + j, b = a + n + 1;
          std::array<int, 3> s{a, b, b + 1}, t{a, b + 1, a + 1};
          if (end == 0.0) std::swap(s[1], s[2]), std::swap(t[1], t[2]);
          mesh.triangles.push_back(s);
          mesh.triangles.push_back(t);
        }
      }
    }
  }
  return mesh;
}

double volume(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles) {
    const auto at = [&](int k) { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
    sum += at(0).dot(at(1).cross(at(2))) / 6.0;
  }
  return sum;
}

double region_area(const TriangleMesh& mesh, const std::vector<int>& region) {
  double sum = 0.0;
  for (const int r : region) {
    const auto& t = mesh.triangles[static_cast<std::size_t>(r)];
    const Vec3 a = mesh.vertices[static_cast<std::size_t>(t[0])];
    sum += 0.5 * (mesh.vertices[static_cast<std::size_t>(t[1])] - a)
                     .cross(mesh.vertices[static_cast<std::size_t>(t[2])] - a)
                     .norm();
  }
  return sum;
}

class MeshFormat : public ::testing::TestWithParam<const char*> {};

TEST_P(MeshFormat, RoundTrip) {
  const Scratch scratch;
  const std::string file = scratch.path(std::string("box") + GetParam());
  write_mesh(file, box_mesh(4));
  const Part part = read_part(file, "cm");
  EXPECT_TRUE(part.is_mesh());
  EXPECT_EQ(part.unit, "cm");
  EXPECT_EQ(part.mesh.vertices.size(), 98u) << "vertices of edges are shared";
  EXPECT_EQ(part.mesh.triangles.size(), 192u);
  EXPECT_NEAR(volume(part.mesh), 24000.0, 1e-2);
  EXPECT_EQ(part.face_count(), 6);
  EXPECT_LT((part.box.high - part.box.low - Vec3(20.0, 30.0, 40.0)).norm(), 1e-5);
}

INSTANTIATE_TEST_SUITE_P(Formats, MeshFormat, ::testing::Values(".stl", ".obj", ".ply"));

TEST(PartMesh, ReadsTextStlAsciiPlyAndBigEndianPly) {
  const Scratch scratch;
  const std::string stl =
      scratch.write("t.stl",
                    "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1e0 0 0\nvertex 0 +1 0\nendloop\n"
                    "endfacet\nendsolid a\n");
  EXPECT_EQ(read_part(stl, "mm").mesh.triangles.size(), 1u);
  const std::string ply = scratch.write(
      "a.ply",
      "ply\r\nformat ascii 1.0\r\ncomment quad\r\nelement vertex 4\r\nproperty float y\r\nproperty float x\r\n"
      "property float z\r\nproperty uchar red\r\nelement face 1\r\nproperty list uchar int vertex_index\r\n"
      "end_header\r\n0 0 0 9\r\n0 2 0 9\r\n1 2 0 9\r\n1 0 0 9\r\n4 0 1 2 3\r\n");
  const Part quad = read_part(ply, "mm");
  EXPECT_EQ(quad.mesh.triangles.size(), 2u);
  EXPECT_LT((quad.box.high - quad.box.low - Vec3(2.0, 1.0, 0.0)).norm(), 1e-12) << "properties in any order";
  std::string big =
      "ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar uint vertex_indices\nend_header\n";
  const std::string zero(4, '\0'), one("\x3f\x80\0\0", 4);
  for (const std::string& word : {zero, zero, zero, one, zero, zero, zero, one, zero}) big += word;
  big += std::string("\3\0\0\0\0\0\0\0\1\0\0\0\2", 13);
  const Part triangle = read_part(scratch.write("b.ply", big), "mm");
  EXPECT_EQ(triangle.mesh.triangles.size(), 1u);
  EXPECT_LT((triangle.box.high - Vec3(1.0, 1.0, 0.0)).norm(), 1e-12);
}

TEST(PartMesh, ReadsObjWithTextureNormalsAndNegativeIndices) {
  const Scratch scratch;
  const std::string obj =
      scratch.write("o.obj",
                    "# a comment\nmtllib x.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0 1.0\nv 0 1 0\nvt 0 0\nvn 0 0 1\n"
                    "f 1/1/1 2//1 3/1 # tail\nf -4 -2 -1\n");
  EXPECT_EQ(read_part(obj, "mm").mesh.triangles.size(), 2u);
}

TEST(PartMesh, ABinaryStlMayBeginWithTheWordSolid) {
  const Scratch scratch;
  const std::string file = scratch.path("s.stl");
  write_mesh(file, box_mesh(1));
  std::fstream(file, std::ios::in | std::ios::out | std::ios::binary) << "solid facet endsolid";
  EXPECT_EQ(read_part(file, "mm").mesh.triangles.size(), 12u);
}

TEST(PartMesh, RepairsAndTells) {
  TriangleMesh mesh = box_mesh(4);
  const auto add = [&](const Vec3& p) {
    mesh.vertices.push_back(p);
    return static_cast<int>(mesh.vertices.size()) - 1;
  };
  std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);  // flipped
  mesh.triangles.push_back(mesh.triangles[10]);           // duplicate
  mesh.triangles.push_back({0, 0, 1});                    // no area
  const Vec3 root = mesh.vertices[static_cast<std::size_t>(mesh.triangles[20][0])];
  mesh.triangles.push_back({mesh.triangles[20][0], mesh.triangles[20][1], add(root - Vec3(0.1, 0.0, 0.0))});  // fin
  mesh.triangles.erase(mesh.triangles.begin() + 40);                                                          // hole
  const Scratch scratch;
  write_mesh(scratch.path("bad.ply"), mesh);
  const Part part = read_part(scratch.path("bad.ply"), "mm");
  EXPECT_EQ(part.mesh.triangles.size(), 191u);
  EXPECT_TRUE(tells(part, "flipped 1 triangles"));
  EXPECT_TRUE(tells(part, "1 duplicate"));
  EXPECT_TRUE(tells(part, "1 zero-area"));
  EXPECT_TRUE(tells(part, "1 triangles of fins"));
  EXPECT_TRUE(tells(part, "left 1 holes"));
  EXPECT_EQ(part.box.low, Vec3::Zero().eval()) << "the fin does not count";
}

TEST(PartMesh, TurnsClosedComponentsOutwards) {
  TriangleMesh mesh = box_mesh(2);
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  const Scratch scratch;
  write_mesh(scratch.path("in.obj"), mesh);
  const Part part = read_part(scratch.path("in.obj"), "mm");
  EXPECT_NEAR(volume(part.mesh), 24.0, 1e-12);
  EXPECT_TRUE(tells(part, "inside out"));
}

TEST(MeshRegions, SidesOfABoxByArea) {
  const Scratch scratch;
  write_mesh(scratch.path("b.ply"), box_mesh(30));
  const Part part = read_part(scratch.path("b.ply"), "mm");
  ASSERT_EQ(part.face_count(), 6);
  const double expected[] = {12.0, 12.0, 8.0, 8.0, 6.0, 6.0};
  for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(region_area(part.mesh, part.mesh_faces[k]), expected[k], 1e-9);
}

// A plate whose edges are rounded in steps of 18 degrees, none of them sharp by itself: still two sides.
TEST(MeshRegions, RoundedEdgesPartTheSidesOfABlade) {
  TriangleMesh mesh;
  const int arc = 11, rows = 40, columns = 40;
  const double radius = 0.2, length = 20.0;
  std::vector<Vec2> outline;
  for (const double side : {1.0, -1.0}) {
    for (int i = 0; i < columns; ++i) outline.emplace_back(side * length * (0.5 - double(i) / columns), side * radius);
    for (int i = 0; i < arc - 1; ++i) {
      const double a = std::numbers::pi * (0.5 + double(i) / (arc - 1));
      outline.emplace_back(side * (-0.5 * length + radius * std::cos(a)), side * radius * std::sin(a));
    }
  }
  const int around = static_cast<int>(outline.size());
  for (int r = 0; r <= rows; ++r)
    for (const Vec2& p : outline) mesh.vertices.emplace_back(p.x(), p.y(), 30.0 * r / rows);
  for (int r = 0; r < rows; ++r) {
    for (int i = 0; i < around; ++i) {
      const int a = r * around + i, b = r * around + (i + 1) % around;
      mesh.triangles.push_back({a, b, b + around});
      mesh.triangles.push_back({a, b + around, a + around});
    }
  }
  const auto regions = mesh_regions(mesh);
  ASSERT_GE(regions.size(), 3u);
  const double side = 30.0 * length;
  EXPECT_NEAR(region_area(mesh, regions[0]), side, 0.03 * side);
  EXPECT_NEAR(region_area(mesh, regions[1]), side, 0.03 * side);
  std::set<int> all;
  std::size_t count = 0;
  for (const auto& region : regions) all.insert(region.begin(), region.end()), count += region.size();
  EXPECT_EQ(count, mesh.triangles.size());
  EXPECT_EQ(all.size(), mesh.triangles.size()) << "every triangle in one region";
}

TEST(PartMesh, ExtractsFacesAsMeshesOfTheirOwn) {
  const Scratch scratch;
  write_mesh(scratch.path("b.ply"), box_mesh(3));
  const Part part = read_part(scratch.path("b.ply"), "mm");
  const TriangleMesh one = extract_mesh(part, {0}), two = extract_mesh(part, {0, 2});
  EXPECT_EQ(one.triangles.size(), 18u);
  EXPECT_EQ(one.vertices.size(), 16u);
  EXPECT_EQ(two.triangles.size(), 36u);
  std::vector<int> all(two.triangles.size());
  std::iota(all.begin(), all.end(), 0);
  EXPECT_NEAR(region_area(two, all), 20.0, 1e-12);
}

TEST(PartMesh, NoisyRotor37BladeIsRepaired) {
  FLANK_REAL_PART(file, "nasty_r37_blade_cm_noisy.stl");
  const std::string message = testing_io::refusal(file);
  for (const char* unit :
       {"`unit`", "mm (4.28 x 7.45 x 4.85 mm)", "cm (42.8 x 74.5 x 48.5 mm)", "in (109 x 189 x 123 mm)"})
    EXPECT_NE(message.find(unit), std::string::npos) << message;
  const Part part = read_part(file, "cm");
  EXPECT_TRUE(tells(part, "20 duplicate"));
  EXPECT_TRUE(tells(part, "flipped 12"));
  EXPECT_TRUE(tells(part, "zero-area"));
  EXPECT_TRUE(tells(part, "fins"));
  EXPECT_TRUE(tells(part, "left 12 holes"));
  EXPECT_NEAR(part.box.high.y() - part.box.low.y(), 74.4, 0.2);
  // The two sides of the blade, whose areas the CAD file gives as 3723 and 3649 before the noise and the holes.
  EXPECT_NEAR(region_area(part.mesh, part.mesh_faces[0]), 3700.0, 110.0);
  EXPECT_NEAR(region_area(part.mesh, part.mesh_faces[1]), 3700.0, 110.0);
}

TEST(PartMesh, NasaBladeIsRepaired) {
  FLANK_REAL_PART(file, "nasa_pyturbo_blade_m.stl");
  (void)testing_io::refusal(file);
  const Part part = read_part(file, "m");
  EXPECT_NEAR(part.box.high.x() - part.box.low.x(), 55.7, 0.1);
  EXPECT_FALSE(part.repairs.empty());
  EXPECT_GT(region_area(part.mesh, part.mesh_faces[1]), 3.0 * region_area(part.mesh, part.mesh_faces[2]));
}

}  // namespace
}  // namespace flank::internal
