#include <gtest/gtest.h>

#include "flank/base/random.h"
#include "flank/error.h"
#include "flank/io/mesh/add_polygon.h"
#include "flank/io/mesh/read_obj.h"
#include "flank/io/mesh/write_mesh.h"
#include "flank/io/text/read_bytes.h"
#include "io/part_files.h"

namespace flank::internal {
namespace {

using Triangle = std::array<int, 3>;

std::string refusal(const std::string& content) {
  try {
    (void)read_obj("a.obj", content);
  } catch (const InputError& e) {
    return e.what();
  }
  return "read";
}

const std::string kFour = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(ReadObj, WhatWasWrittenIsReadBackExactly) {
  Random random(1);
  TriangleMesh mesh;
  for (int i = 0; i < 40; ++i)
    mesh.vertices.emplace_back(random.normal(), 1e9 * random.normal(), 1e-9 * random.normal());
  for (int i = 0; i < 60; ++i)
    mesh.triangles.push_back({static_cast<int>(random.next() % 40), static_cast<int>(random.next() % 40),
                              static_cast<int>(random.next() % 40)});
  const testing_io::Scratch scratch;
  write_mesh(scratch.path("a.obj"), mesh);
  const TriangleMesh back = read_obj("a.obj", read_bytes(scratch.path("a.obj")));
  EXPECT_EQ(back.vertices, mesh.vertices);
  EXPECT_EQ(back.triangles, mesh.triangles);
}

TEST(ReadObj, PolygonsBecomeFansAboutTheirFirstCorner) {
  const TriangleMesh mesh = read_obj("a.obj", kFour + "v 2 2 2\nf 1 2 3 4 5\n");
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
}

double area(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const auto corner = [&](int k) { return mesh.vertices[static_cast<std::size_t>(t[static_cast<std::size_t>(k)])]; };
    sum += 0.5 * (corner(1) - corner(0)).cross(corner(2) - corner(0)).norm();
  }
  return sum;
}

TEST(ReadObj, ConcavePolygonsKeepTheirArea) {
  // An L, from every corner, both ways round.
  for (int first = 0; first < 6; ++first)
    for (const int way : {1, -1}) {
      std::string face = "f";
      for (int k = 0; k < 6; ++k) face += " " + std::to_string(1 + (first + way * k + 12) % 6);
      const TriangleMesh mesh =
          read_obj("a.obj", "v 0 0 0\nv 3 0 0\nv 3 1 0\nv 1 1 0\nv 1 3 0\nv 0 3 0\n" + face + "\n");
      EXPECT_EQ(mesh.triangles.size(), 4u);
      EXPECT_NEAR(area(mesh), 5.0, 1e-12) << face;
      for (const Triangle& t : mesh.triangles) {
        const Vec3 a = mesh.vertices[static_cast<std::size_t>(t[0])], b = mesh.vertices[static_cast<std::size_t>(t[1])],
                   c = mesh.vertices[static_cast<std::size_t>(t[2])];
        EXPECT_GE(way * (b - a).cross(c - a).z(), 0.0) << "turned over";
      }
    }
}

TEST(ReadObj, ACombOfManyTeethKeepsItsArea) {
  std::string text, face = "f";
  int count = 0;
  const auto corner = [&](double x, double y) {
    text += "v " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(0.5 * x) + "\n";
    face += " " + std::to_string(++count);
  };
  constexpr int kTeeth = 30;
  for (int k = 0; k < kTeeth; ++k) corner(2 * k, 1), corner(2 * k, 9), corner(2 * k + 1, 9), corner(2 * k + 1, 1);
  corner(2 * kTeeth - 1, 0), corner(0, 0);
  const TriangleMesh mesh = read_obj("a.obj", text + face + "\n");
  EXPECT_NEAR(area(mesh), (kTeeth * 8.0 + 2.0 * kTeeth - 1.0) * std::sqrt(1.25), 1e-4);
}

TEST(ReadObj, NegativeIndicesCountBackFromWhatIsThereSoFar) {
  const TriangleMesh mesh = read_obj("a.obj", kFour + "f -4 -3 -1\nv 5 5 5\nf -1 -2 -3\n");
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 3}, {4, 3, 2}}));
}

TEST(ReadObj, WhatIsNoGeometryIsPassedOver) {
  const TriangleMesh mesh = read_obj("a.obj",
                                     "# comment\nmtllib x\no part\ng a b\nv 0 0 0 1.0\nv 1 0 0 0.5 0.5 0.5\nv 0 1 0\n"
                                     "vt 0 0\nvn 0 0 1\nusemtl red\ns off\nl 1 2\np 1\nf 1/1/1 2//1 3/1 # tail\n");
  EXPECT_EQ(mesh.vertices.size(), 3u);
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}}));
}

TEST(ReadObj, BadLinesAreRefusedByTheirNumber) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"v 1 2\n", "a.obj, line 1: a vertex needs three coordinates"},
      {"v 1 2 three\n", "a.obj, line 1: \"three\" is not a number"},
      {"v 1 2 inf\n", "a.obj, line 1: \"inf\" is not a finite number; expected finite coordinates"},
      {kFour + "f 1 2\n", "a.obj, line 5: a face needs at least three vertices"},
      {kFour + "f 1 2 # 3\n", "a.obj, line 5: a face needs at least three vertices"},
      {kFour + "f 1 2 5\n", "a.obj, line 5: vertex 5 does not exist; there are 4 so far"},
      {kFour + "f 1 2 0\n", "a.obj, line 5: vertex 0 does not exist; there are 4 so far"},
      {kFour + "f 1 2 -5\n", "a.obj, line 5: vertex -5 does not exist; there are 4 so far"},
      {kFour + "f 1 2 x\n", "a.obj, line 5: \"x\" is not a whole number"},
      {kFour + "f 1 2 -9223372036854775808\n",
       "a.obj, line 5: vertex -9223372036854775808 does not exist; there are 4 so far"},
      {"f 1 2 3\n" + kFour, "a.obj, line 1: vertex 1 does not exist; there are 0 so far"}};
  for (const auto& [text, expected] : cases) EXPECT_EQ(refusal(text), expected) << text;
}

TEST(AddPolygon, OfFewerThanThreeCornersAddsNothing) {
  const int corners[] = {4, 5, 6, 7};
  for (const auto& [count, triangles] :
       {std::pair(0, 0u), std::pair(1, 0u), std::pair(2, 0u), std::pair(3, 1u), std::pair(4, 2u)}) {
    TriangleMesh mesh;
    add_polygon(mesh, corners, count);
    EXPECT_EQ(mesh.triangles.size(), triangles);
  }
}

}  // namespace
}  // namespace flank::internal
