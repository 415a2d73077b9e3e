// Bad files: each ends in an InputError of one line that names the file and says what would be accepted. A bug in a
// reader becomes a file of tests/corpus and a line here.
#include <gtest/gtest.h>

#include <array>
#include <string_view>

#include "flank/base/random.h"
#include "flank/io/mesh/write_mesh.h"
#include "flank/io/text/read_bytes.h"
#include "flank/io/text/step_syntax.h"
#include "io/part_files.h"
#include "sanitized.h"

namespace flank::internal {
namespace {

using testing_io::corpus;
using testing_io::refusal;
using testing_io::Scratch;

struct BadFile {
  const char* name;
  const char* says;  ///< part of the message
};

class Corpus : public ::testing::TestWithParam<BadFile> {};

TEST_P(Corpus, IsRefused) {
  const std::string message =
      refusal(corpus(GetParam().name),
              std::string_view(GetParam().name).starts_with("mesh/") ? std::optional<std::string>("mm") : std::nullopt);
  EXPECT_NE(message.find(GetParam().says), std::string::npos) << message;
}

INSTANTIATE_TEST_SUITE_P(
    BadFiles, Corpus,
    ::testing::Values(BadFile{"cad/empty.step", "is empty"}, BadFile{"cad/prose.step", "not STEP"},
                      BadFile{"cad/stl_named.step", "content is STL"}, BadFile{"cad/step_named.stl", "content is STEP"},
                      BadFile{"cad/unknown.xyz", "accepted: STEP"}, BadFile{"cad/truncated.step", "truncated"},
                      BadFile{"cad/no_faces.step", "no faces"}, BadFile{"cad/lost_entity.step", "not defined"},
                      BadFile{"cad/truncated.iges", "truncated"}, BadFile{"cad/no_faces.iges", ""},
                      BadFile{"cad/old_brep_version.brep", "BREP"}, BadFile{"cad/truncated.brep", ""},
                      BadFile{"mesh/nan.stl", "line 5"}, BadFile{"mesh/two_corners.stl", "line 6"},
                      BadFile{"mesh/four_corners.stl", "line 7"}, BadFile{"mesh/truncated.stl", "truncated"},
                      BadFile{"mesh/word.stl", "not a word"}, BadFile{"mesh/empty.stl", "no triangles"},
                      BadFile{"mesh/zero_area.stl", "area"}, BadFile{"mesh/index.obj", "line 4"},
                      BadFile{"mesh/zero_index.obj", "line 4"}, BadFile{"mesh/not_a_number.obj", "line 2"},
                      BadFile{"mesh/infinite.obj", "finite"}, BadFile{"mesh/no_faces.obj", "no triangles"},
                      BadFile{"mesh/index.ply", "does not exist"}, BadFile{"mesh/truncated.ply", "truncated"},
                      BadFile{"mesh/format.ply", "ascii"}, BadFile{"mesh/header.ply", "end_header"},
                      BadFile{"mesh/type.ply", "not a type"}, BadFile{"mesh/huge_count.ply", "truncated"}),
    [](const auto& test) {
      std::string name = test.param.name;
      for (char& c : name)
        if (c == '.' || c == '/') c = '_';
      return name;
    });

TEST(Refusals, MissingFileAndFolder) {
  EXPECT_NE(refusal(corpus("not_there.step")).find("no such file"), std::string::npos);
  EXPECT_NE(refusal(FLANK_SOURCE_DIR).find("folder"), std::string::npos);
}

TEST(Refusals, TruncatedRotor37) {
  FLANK_REAL_PART(file, "nasty_r37_truncated.step");
  EXPECT_NE(refusal(file).find("truncated"), std::string::npos);
}

TEST(Refusals, BinaryStlOfTheWrongSize) {
  const Scratch scratch;
  std::string bytes(84 + 50 * 2, '\0');
  bytes[80] = 3;
  EXPECT_NE(refusal(scratch.write("short.stl", bytes), "mm").find("count of 3 facets"), std::string::npos);
}

TEST(Refusals, BinaryStlWithInfinity) {
  const Scratch scratch;
  std::string bytes(84 + 50 * 2, '\0');
  bytes[80] = 2;
  const std::array<char, 4> infinity = {0, 0, static_cast<char>(0x80), 0x7f};
  std::copy(infinity.begin(), infinity.end(), bytes.begin() + 84 + 50 + 12);
  EXPECT_NE(refusal(scratch.write("inf.stl", bytes), "mm").find("facet 2"), std::string::npos);
}

TEST(Refusals, UnknownUnitIsWrongUsage) {
  EXPECT_THROW((void)read_part(corpus("mesh/zero_area.stl"), "furlong"), UsageError);
}

// Every prefix of a good file is refused or read, never a crash or another kind of exception.
TEST(Refusals, PrefixesOfGoodFiles) {
  const Scratch scratch;
  const std::string good = read_bytes(testing_io::own_part("inch_cylinder.step"));
  for (std::size_t length = 1; length < good.size() * 9 / 10; length += good.size() / 12) {
    const std::string file = scratch.write("prefix.step", good.substr(0, length) + "\nENDSEC;\nEND-ISO-10303-21;\n");
    EXPECT_THROW((void)read_part(file), InputError) << length;
  }
}

// Bytes of good meshes exchanged at random: read or refused, never anything else.
TEST(Refusals, MutatedMeshes) {
  constexpr int kMutants = kSanitized ? 300 : 1000;
  const Scratch scratch;
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  int refused = 0;
  for (const std::string extension : {".stl", ".obj", ".ply"}) {
    const std::string file = scratch.path("mutant" + extension);
    write_mesh(file, mesh);
    const std::string good = read_bytes(file);
    Random random(17);
    for (int i = 0; i < kMutants; ++i) {
      std::string bad = good;
      for (int k = 0; k < 1 + i % 4; ++k)
        bad[static_cast<std::size_t>(random.next() % bad.size())] = static_cast<char>(random.next() % 256);
      if (i % 3 == 0) bad.resize(static_cast<std::size_t>(random.next() % bad.size()) + 1);
      try {
        (void)read_part(scratch.write("mutant" + extension, bad), "mm");
      } catch (const InputError&) {
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, kMutants);
}

TEST(Refusals, LostReferencesOfStep) {
  EXPECT_EQ(undefined_step_references("DATA;\n#1=A(#2,'#9');\n#2 =B(#3,#12);\nENDSEC;"), (std::vector<long>{3, 12}));
  EXPECT_TRUE(undefined_step_references("DATA;\n#1=A('it''s #4',#1);ENDSEC;").empty());
}

}  // namespace
}  // namespace flank::internal
