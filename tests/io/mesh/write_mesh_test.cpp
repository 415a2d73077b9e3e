#include "flank/io/mesh/write_mesh.h"

#include <gtest/gtest.h>

#include <cstring>

#include "flank/error.h"
#include "flank/io/mesh/read_stl.h"
#include "flank/io/text/read_bytes.h"
#include "io/part_files.h"

namespace flank::internal {
namespace {

using testing_io::fs::exists;

TriangleMesh two() {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {0.1, 0, 0}, {0, 1.0 / 3.0, 0}, {0, 0, 1e-9}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

std::string written(const std::string& extension, const TriangleMesh& mesh) {
  const testing_io::Scratch scratch;
  write_mesh(scratch.path("a" + extension), mesh);
  return read_bytes(scratch.path("a" + extension));
}

float single(const std::string& bytes, std::size_t at) {
  float value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

TEST(WriteMesh, ObjIsPlainTextThatCountsFromOne) {
  EXPECT_EQ(written(".obj", two()), "v 0 0 0\nv 0.1 0 0\nv 0 0.3333333333333333 0\nv 0 0 1e-09\nf 1 2 3\nf 1 3 4\n");
}

TEST(WriteMesh, StlHasItsSizeItsCountAndUnitNormals) {
  const std::string bytes = written(".stl", two());
  ASSERT_EQ(bytes.size(), 84u + 2 * 50u);
  EXPECT_TRUE(is_binary_stl(bytes));
  EXPECT_NE(bytes.substr(0, 5), "solid") << "which readers take for text";
  EXPECT_EQ(single(bytes, 84 + 8), 1.0f) << "the normal of the first is z";
  EXPECT_EQ(single(bytes, 84 + 12 + 12), 0.1f);
  EXPECT_EQ(single(bytes, 84 + 50), 1.0f) << "the normal of the second is x";
  EXPECT_EQ(bytes.substr(84 + 48, 2), std::string(2, '\0'));
}

TEST(WriteMesh, PlyStatesWhatItHolds) {
  const std::string bytes = written(".ply", two());
  EXPECT_EQ(bytes.rfind("ply\nformat binary_little_endian 1.0\nelement vertex 4\n", 0), 0u);
  EXPECT_NE(bytes.find("element face 2\n"), std::string::npos);
  const std::size_t head = bytes.find("end_header\n") + 11;
  EXPECT_EQ(bytes.size(), head + 4 * 24 + 2 * 13);
}

TEST(WriteMesh, TheSameMeshGivesTheSameBytes) {
  for (const char* extension : {".stl", ".obj", ".ply"})
    EXPECT_TRUE(written(extension, two()) == written(extension, two()));
}

TEST(WriteMesh, AMeshOfNothingIsAFileOfNothing) {
  EXPECT_EQ(written(".stl", TriangleMesh()).size(), 84u);
  EXPECT_NE(written(".ply", TriangleMesh()).find("element vertex 0\n"), std::string::npos);
}

TEST(WriteMesh, OtherExtensionsAndFoldersThatAreNotThereAreRefused) {
  const testing_io::Scratch scratch;
  for (const char* name : {"a", "a.STL", "a.3mf", "a.step"}) {
    EXPECT_THROW(write_mesh(scratch.path(name), two()), UsageError) << name;
    EXPECT_FALSE(exists(scratch.path(name)));
  }
  EXPECT_THROW(write_mesh(scratch.path("none/a.stl"), two()), InputError);
}

}  // namespace
}  // namespace flank::internal
