#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "flank/base/random.h"
#include "flank/error.h"
#include "flank/io/mesh/read_ply.h"
#include "flank/io/mesh/write_mesh.h"
#include "flank/io/text/read_bytes.h"
#include "io/part_files.h"

namespace flank::internal {
namespace {

using Triangle = std::array<int, 3>;

std::string refusal(const std::string& content) {
  try {
    (void)read_ply("a.ply", content);
  } catch (const InputError& e) {
    return e.what();
  }
  return "read";
}

/// The bytes of a value, first the lowest or first the highest.
template <class T>
std::string bytes(T value, bool big) {
  std::string raw(sizeof value, '\0');
  std::memcpy(raw.data(), &value, sizeof value);
  if (big) std::reverse(raw.begin(), raw.end());
  return raw;
}

std::string head(const std::string& format, const std::string& number, const std::string& count,
                 const std::string& index) {
  return "ply\nformat " + format + " 1.0\nelement vertex 3\nproperty " + number + " x\nproperty " + number +
         " y\nproperty " + number + " z\nelement face 1\nproperty list " + count + " " + index +
         " vertex_indices\nend_header\n";
}

/// Corners (0, 0, 0), (1, 0, 0), (0, 2, 0) in one type of number.
template <class Number, class Count, class Index>
std::string body(bool big) {
  std::string text;
  for (const int v : {0, 0, 0, 1, 0, 0, 0, 2, 0}) text += bytes(static_cast<Number>(v), big);
  text += bytes(static_cast<Count>(3), big);
  for (const int v : {2, 0, 1}) text += bytes(static_cast<Index>(v), big);
  return text;
}

void expect_triangle(const std::string& content) {
  const TriangleMesh mesh = read_ply("a.ply", content);
  EXPECT_EQ(mesh.vertices, (std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}}));
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{2, 0, 1}}));
}

TEST(ReadPly, WhatWasWrittenIsReadBackExactly) {
  Random random(1);
  TriangleMesh mesh;
  for (int i = 0; i < 40; ++i)
    mesh.vertices.emplace_back(random.normal(), 1e9 * random.normal(), 1e-9 * random.normal());
  for (int i = 0; i < 60; ++i)
    mesh.triangles.push_back({static_cast<int>(random.next() % 40), static_cast<int>(random.next() % 40),
                              static_cast<int>(random.next() % 40)});
  const testing_io::Scratch scratch;
  write_mesh(scratch.path("a.ply"), mesh);
  const TriangleMesh back = read_ply("a.ply", read_bytes(scratch.path("a.ply")));
  EXPECT_EQ(back.vertices, mesh.vertices);
  EXPECT_EQ(back.triangles, mesh.triangles);
}

TEST(ReadPly, EveryTypeOfNumberInBothByteOrders) {
  for (const bool big : {false, true}) {
    const std::string format = big ? "binary_big_endian" : "binary_little_endian";
    expect_triangle(head(format, "float", "uchar", "int") + body<float, std::uint8_t, std::int32_t>(big));
    expect_triangle(head(format, "double", "char", "uint") + body<double, std::int8_t, std::uint32_t>(big));
    expect_triangle(head(format, "float64", "uint16", "int16") + body<double, std::uint16_t, std::int16_t>(big));
    expect_triangle(head(format, "short", "int", "uint8") + body<std::int16_t, std::int32_t, std::uint8_t>(big));
    expect_triangle(head(format, "int8", "short", "ushort") + body<std::int8_t, std::int16_t, std::uint16_t>(big));
    expect_triangle(head(format, "uint32", "int8", "char") + body<std::uint32_t, std::int8_t, std::int8_t>(big));
  }
}

TEST(ReadPly, TextHasOneRowALineAndOtherThingsArePassedOver) {
  const TriangleMesh mesh =
      read_ply("a.ply",
               "ply\nformat ascii 1.0\ncomment made by hand\nobj_info x\nelement camera 2\n"
               "property float f\nelement vertex 4\nproperty list uchar float tags\nproperty double z\n"
               "property double x\nproperty double y\nelement face 2\nproperty uchar red\n"
               "property list uchar int other\nproperty list uchar int vertex_index\nend_header\n"
               "1\n2\n2 9 9 0.5 1 2\n0 0.25 3 4\n\n0 0 5 6\n1 8 0 7 8\n"
               "255 1 9 3 0 1 2\n0 0 4 0 1 2 3\n");
  EXPECT_EQ(mesh.vertices, (std::vector<Vec3>{{1, 2, 0.5}, {3, 4, 0.25}, {5, 6, 0}, {7, 8, 0}}));
  EXPECT_EQ(mesh.triangles, (std::vector<Triangle>{{0, 1, 2}, {0, 1, 2}, {0, 2, 3}}));
}

TEST(ReadPly, BadHeadsAreRefused) {
  const std::string start = "ply\nformat ascii 1.0\n";
  const std::vector<std::pair<std::string, std::string>> cases = {
      {start + "element vertex 3\n", "the header does not end with \"end_header\""},
      {start + "element vertex -3\nend_header\n", "line 3: an element count is negative"},
      {start + "element vertex many\nend_header\n", "line 3: \"many\" is not a whole number"},
      {start + "property float x\nend_header\n", "line 3: a property comes before its element"},
      {start + "element vertex 1\nproperty half x\nend_header\n", "line 4: \"half\" is not a type"},
      {start + "element vertex 1\nproperty list float\nend_header\n", "line 4: \"\" is not a type"},
      {"ply\nformat binary 1.0\nend_header\n", "format \"binary\" is not supported"},
      {"ply\nend_header\n", "format \"\" is not supported"}};
  for (const auto& [text, expected] : cases)
    EXPECT_NE(refusal(text).find(expected), std::string::npos) << refusal(text) << "\n for " << text;
}

TEST(ReadPly, RowsOfNothingWithoutAnEndAreRefused) {
  // Nothing would ever say that the file is over.
  for (const char* element : {"vertex", "face", "other"}) {
    const std::string text =
        std::string("ply\nformat binary_little_endian 1.0\nelement ") + element + " 9000000000000000000\nend_header\n";
    EXPECT_NE(refusal(text).find("has no properties"), std::string::npos) << element;
  }
  EXPECT_EQ(refusal("ply\nformat ascii 1.0\nelement other 0\nend_header\n"), "read");
}

TEST(ReadPly, BadBodiesAreRefusedByRow) {
  const std::string good =
      head("binary_little_endian", "float", "uchar", "int") + body<float, std::uint8_t, std::int32_t>(false);
  ASSERT_EQ(refusal(good), "read");
  EXPECT_EQ(refusal(good.substr(0, good.size() - 1)),
            "a.ply, face 1: the file ends here and is truncated; copy or export it again");
  EXPECT_EQ(refusal(good.substr(0, good.size() - 20)),
            "a.ply, vertex 3: the file ends here and is truncated; copy or export it again");
  std::string lost = good;
  lost[lost.size() - 4] = 3;
  EXPECT_EQ(refusal(lost), "a.ply, face 1: vertex 3 does not exist; there are 3");
  std::string negative = good;
  negative[negative.size() - 1] = static_cast<char>(0x80);
  EXPECT_NE(refusal(negative).find("does not exist"), std::string::npos);
  std::string nan = good;
  const float x = std::nanf("");
  std::memcpy(nan.data() + nan.size() - 13 - 12, &x, 4);
  EXPECT_EQ(refusal(nan), "a.ply, vertex 3: a coordinate is not a finite number; expected finite coordinates");
  const std::string text = head("ascii", "float", "uchar", "int");
  EXPECT_NE(refusal(text + "0 0 0\n1 0\n0 2 0\n3 0 1 2\n").find("too few values for a vertex"), std::string::npos);
  EXPECT_NE(refusal(text + "0 0 0\n1 0 0\n0 2 0\n4 0 1 2\n").find("too few values for a face"), std::string::npos);
  EXPECT_NE(refusal(text + "0 0 0\n1 0 0\n0 2 0\n").find("truncated"), std::string::npos);
}

}  // namespace
}  // namespace flank::internal
