#include <gtest/gtest.h>
#include <unistd.h>

#include "layers/include_rules.h"

namespace flank::layers {
namespace {

const fs::path kRoot = FLANK_SOURCE_DIR;

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  return text;
}

TEST(Layers, EveryIncludeIsAllowed) {
  TreeCheck check(kRoot, read_layer_table(kRoot / "src/flank/layers.txt"));
  EXPECT_EQ(joined(check.violations()), "");
}

TEST(Layers, TheTreeIsRead) { EXPECT_GT(sources_below(kRoot / "src/flank").size(), 20u); }

TEST(Layers, ArchitectureShowsTheSameTable) {
  EXPECT_EQ(read_documented_table(kRoot / "ARCHITECTURE.md"), read_layer_table(kRoot / "src/flank/layers.txt"));
}

TEST(Layers, TheJudgeSeesNothingOfThePlanner) {
  const LayerTable table = read_layer_table(kRoot / "src/flank/layers.txt");
  for (const char* folder : {"surface", "motion", "envelope", "clearance", "seed", "fit", "cover", "trochoid"}) {
    EXPECT_FALSE(table.at("verify").contains(folder)) << folder;
    EXPECT_FALSE(table.at(folder).contains("verify")) << folder;
  }
}

/// A small tree of its own, removed at the end.
class PlantedTree : public ::testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::path(::testing::TempDir()) / ("flank_layers_" + std::to_string(::getpid()));
    fs::remove_all(root_);
    write("src/flank/layers.txt", "# comment\nlow:\nhigh: low\nio: low\n");
    write("src/flank/low/a.h", "#pragma once\n#include <vector>\n");
    write("src/flank/low/a.cpp", "#include \"flank/low/a.h\"\n");
    write("src/flank/high/b.h", "#pragma once\n#include \"flank/low/a.h\"\n#include <Eigen/Core>\n");
    write("src/flank/io/read_occt.h", "#pragma once\n#include <TopoDS_Shape.hxx>\n");
    write("apps/tool/main.cpp", "#include \"flank/high/b.h\"\n");
  }
  void TearDown() override { fs::remove_all(root_); }

  void write(const std::string& file, const std::string& text) {
    fs::create_directories((root_ / file).parent_path());
    std::ofstream(root_ / file) << text;
  }
  std::vector<std::string> violations() {
    return TreeCheck(root_, read_layer_table(root_ / "src/flank/layers.txt")).violations();
  }
  /// Writes one file and expects exactly one violation, in it, that says `what`.
  void expect_found(const std::string& file, const std::string& text, const std::string& what) {
    write(file, text);
    const std::vector<std::string> found = violations();
    ASSERT_EQ(found.size(), 1u) << joined(found);
    EXPECT_TRUE(found.front().starts_with(file)) << found.front();
    EXPECT_NE(found.front().find(what), std::string::npos) << found.front();
    fs::remove(root_ / file);
  }

  fs::path root_;
};

TEST_F(PlantedTree, IsCleanBeforeAnythingIsPlanted) { EXPECT_EQ(joined(violations()), ""); }

TEST_F(PlantedTree, FindsAnIncludeUpwards) {
  expect_found("src/flank/low/up.cpp", "\n#include \"flank/high/b.h\"\n", ":2: low may not include high");
  expect_found("src/flank/low/up.cpp", "#  include <flank/high/b.h>\n", "low may not include high");
}

TEST_F(PlantedTree, FindsUnknownFolders) {
  expect_found("src/flank/utils/x.h", "#pragma once\n", "the folder utils is not in layers.txt");
}

TEST_F(PlantedTree, FindsIncludesOfWhatIsNotThere) {
  expect_found("src/flank/high/c.cpp", "#include \"flank/low/none.h\"\n", "there is no flank/low/none.h");
  expect_found("apps/tool/more.cpp", "#include \"flank/high/none.h\"\n", "there is no flank/high/none.h");
}

TEST_F(PlantedTree, FindsRelativeIncludes) {
  expect_found("src/flank/low/c.cpp", "#include \"../high/b.h\"\n", "is not a path below src");
}

TEST_F(PlantedTree, KeepsTheCadKernelInIo) {
  expect_found("src/flank/high/c.cpp", "#include <gp_Pnt.hxx>\n", "outside io");
  expect_found("apps/tool/more.cpp", "#include <gp_Pnt.hxx>\n", "outside io");
  expect_found("src/flank/io/part.h", "#pragma once\n#include <gp_Pnt.hxx>\n", "not named for it");
}

TEST_F(PlantedTree, KeepsThirdPartiesOutOfHeaders) {
  expect_found("src/flank/io/t.h", "#pragma once\n#include <nlohmann/json.hpp>\n", "not named for it");
  expect_found("src/flank/low/t.h", "#pragma once\n#include <fmt/core.h>\n", "in a header");
  expect_found("src/flank/low/t.cpp", "#include <tbb/parallel_for.h>\n", "use base/parallel.h");
}

TEST_F(PlantedTree, FindsHeadersWithoutAGuardOrOutOfOrder) {
  expect_found("src/flank/low/g.h", "int x();\n", "no #pragma once");
  write("src/flank/low/o.h", "#pragma once\n");
  expect_found("src/flank/low/o.cpp", "#include <vector>\n#include \"flank/low/o.h\"\n",
               "the first include is not flank/low/o.h");
}

TEST_F(PlantedTree, RefusesATableWithACycle) {
  write("src/flank/layers.txt", "low: high\nhigh: low\n");
  EXPECT_THROW((void)read_layer_table(root_ / "src/flank/layers.txt"), std::runtime_error);
}

}  // namespace
}  // namespace flank::layers
