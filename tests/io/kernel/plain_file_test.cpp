// Files that begin with a byte order mark are what they are without it.
#include "flank/io/kernel/plain_file.h"

#include <gtest/gtest.h>

#include "flank/io/mesh/write_mesh.h"
#include "flank/io/text/read_bytes.h"
#include "io/kernel_files.h"

namespace flank::internal {
namespace {

using testing_io::Scratch;

TEST(PlainFile, IsTheFileItselfOrACopyWithoutItsMark) {
  const Scratch scratch;
  const std::string plain = scratch.write("plain", "as it is"), marked = scratch.write("marked", "\xEF\xBB\xBFrest");
  EXPECT_EQ(PlainFile(plain).name(), plain);
  const PlainFile copy(marked);
  EXPECT_NE(copy.name(), marked);
  EXPECT_EQ(read_bytes(copy.name()), "rest");
}

TEST(ByteOrderMark, MeansNothingInAnyFormat) {
  const TopoDS_Shape block = testing_io::bored_block();
  const std::string step = testing_io::step_text(block), iges = testing_io::iges_text(block, true),
                    brep = testing_io::brep_text(block);
  const Scratch scratch;
  TriangleMesh mesh;
  mesh.vertices = {Vec3(0, 0, 0), Vec3(30, 0, 0), Vec3(0, 20, 0), Vec3(0, 0, 10)};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  const std::string text_stl =
      "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 9 0 0\nvertex 0 9 0\nendloop\nendfacet\nendsolid "
      "s\n";
  std::vector<std::pair<std::string, std::string>> files{
      {"a.step", step}, {"a.igs", iges}, {"a.brep", brep}, {"text.stl", text_stl}};
  for (const char* name : {"a.stl", "a.obj", "a.ply"}) {
    write_mesh(scratch.path(name), mesh);
    files.emplace_back(name, read_bytes(scratch.path(name)));
  }
  for (const auto& [name, content] : files) {
    SCOPED_TRACE(name);
    const Part sound = read_part(scratch.write(name, content), "mm");
    const Part marked = read_part(scratch.write(name, "\xEF\xBB\xBF" + content), "mm");
    EXPECT_EQ(marked.face_count(), sound.face_count());
    EXPECT_EQ(marked.repairs, sound.repairs);
    EXPECT_EQ(marked.box.high, sound.box.high);
    EXPECT_NE(marked.sha256, sound.sha256) << "the file is another one";
  }
}

TEST(Sniff, APointerOfALargeFileIsNotTheFile) {
  const Scratch scratch;
  const std::string pointer = "version https://git-lfs.github.com/spec/v1\noid sha256:00\nsize 892888121\n";
  for (const char* name : {"part.stl", "part.step", "part.obj"})
    EXPECT_NE(testing_io::refusal(scratch.write(name, pointer), "mm").find("a Git LFS pointer, not the file"),
              std::string::npos);
}

}  // namespace
}  // namespace flank::internal
