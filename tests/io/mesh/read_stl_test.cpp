#include <gtest/gtest.h>

#include <cstring>

#include "flank/base/random.h"
#include "flank/error.h"
#include "flank/io/mesh/read_stl.h"
#include "flank/io/mesh/write_mesh.h"
#include "flank/io/text/read_bytes.h"
#include "io/part_files.h"

namespace flank::internal {
namespace {

std::string refusal(const std::string& content) {
  try {
    (void)read_stl("a.stl", content);
  } catch (const InputError& e) {
    return e.what();
  }
  return "read";
}

const std::string kFacet =
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";

TEST(ReadStl, WhatWasWrittenIsReadBackInSinglePrecision) {
  Random random(1);
  TriangleMesh mesh;
  for (int i = 0; i < 50; ++i) {
    for (int k = 0; k < 3; ++k)
      mesh.vertices.emplace_back(random.normal(), 1e6 * random.normal(), 1e-6 * random.normal());
    mesh.triangles.push_back({3 * i, 3 * i + 2, 3 * i + 1});
  }
  const testing_io::Scratch scratch;
  write_mesh(scratch.path("a.stl"), mesh);
  const TriangleMesh back = read_stl("a.stl", read_bytes(scratch.path("a.stl")));
  ASSERT_EQ(back.triangles.size(), 50u);
  ASSERT_EQ(back.vertices.size(), 150u) << "every facet has corners of its own";
  for (std::size_t i = 0; i < 50; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3& wanted = mesh.vertices[static_cast<std::size_t>(mesh.triangles[i][k])];
      const Vec3& found = back.vertices[static_cast<std::size_t>(back.triangles[i][k])];
      for (int c = 0; c < 3; ++c) ASSERT_EQ(found[c], static_cast<double>(static_cast<float>(wanted[c])));
    }
  }
}

TEST(ReadStl, TextKeepsTheOrderOfCornersAndEveryDigit) {
  const TriangleMesh mesh = read_stl("a.stl",
                                     "\n solid some name of it\n  facet normal 9 9 9\n\touter loop\r\nvertex 0.1 -2e-3 "
                                     "+3\nvertex 1 0 0.333333333333333\n"
                                     "vertex 0 1 0 trailing\nendloop\nendfacet\n" +
                                         kFacet + "endsolid some name of it\nsolid another\n" + kFacet + "endsolid\n");
  ASSERT_EQ(mesh.triangles.size(), 3u);
  EXPECT_EQ(mesh.vertices[0], Vec3(0.1, -2e-3, 3.0));
  EXPECT_EQ(mesh.vertices[1], Vec3(1.0, 0.0, 0.333333333333333));
  EXPECT_EQ(mesh.triangles[1], (std::array<int, 3>{3, 4, 5}));
}

TEST(ReadStl, ABinaryFileThatBeginsWithSolidIsBinary) {
  std::string bytes(84 + 50, '\0');
  bytes.replace(0, 11, "solid facet");
  bytes[80] = 1;
  const float x[9] = {0, 0, 0, 2, 0, 0, 0, 3, 0};
  std::memcpy(bytes.data() + 84 + 12, x, sizeof x);
  const TriangleMesh mesh = read_stl("a.stl", bytes);
  ASSERT_EQ(mesh.triangles.size(), 1u);
  EXPECT_EQ(mesh.vertices[1], Vec3(2, 0, 0));
  EXPECT_EQ(mesh.vertices[2], Vec3(0, 3, 0));
}

TEST(ReadStl, BadTextIsRefusedByItsLine) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"solid a\n" + kFacet, "a.stl, line 8: the file ends before its \"endsolid\""},
      {"solid a\n" + kFacet + "endsolid\nsolid b\n" + kFacet.substr(0, 43), "a.stl, line 13: the file ends before"},
      {"solid a\nfacet\nvertex 1 2\n", "a.stl, line 3: a vertex needs three coordinates"},
      {"solid a\nfacet\nvertex 1 2 x\n", "a.stl, line 3: \"x\" is not a number"},
      {"solid a\nfacet\nvertex 1 2 nan\n", "a.stl, line 3: \"nan\" is not a finite number"},
      {"solid a\nfacet\nvertex 0 0 0\nvertex 1 0 0\nendfacet\n", "a.stl, line 5: a facet has fewer than three"},
      {"solid a\nfacet\nvertex 0 0 0\nvertex 1 0 0\nvertex 1 0 0\nvertex 1 1 0\n",
       "a.stl, line 6: a facet has more than"},
      {"solid a\nfacets\n", "a.stl, line 2: \"facets\" is not a word"}};
  for (const auto& [text, expected] : cases)
    EXPECT_EQ(refusal(text).rfind(expected, 0), 0u) << refusal(text) << "\n for " << text;
}

TEST(ReadStl, BadBytesAreRefusedByTheirFacet) {
  std::string bytes(84 + 150, '\0');
  bytes[80] = 3;
  EXPECT_EQ(refusal(bytes), "read");
  const std::uint32_t nan = 0x7fc00000;
  std::memcpy(bytes.data() + 84 + 50 + 12 + 8, &nan, 4);
  EXPECT_NE(refusal(bytes).find("a.stl, facet 2: a coordinate is not a finite number"), std::string::npos);
  EXPECT_NE(refusal(bytes.substr(0, 200)).find("(200 bytes; its count of 3 facets takes 234)"), std::string::npos);
  EXPECT_NE(refusal("short").find("truncated or not an STL file"), std::string::npos);
}

TEST(ReadStl, NormalsOfTheFileAreNotBelieved) {
  std::string bytes(84 + 50, '\0');
  bytes[80] = 1;
  const std::uint32_t nan = 0x7fc00000;
  for (int k = 0; k < 3; ++k) std::memcpy(bytes.data() + 84 + 4 * k, &nan, 4);
  EXPECT_EQ(refusal(bytes), "read") << "corners alone count";
}

}  // namespace
}  // namespace flank::internal
