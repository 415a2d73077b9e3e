#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <fstream>
#include <set>
#include <string>
#include <vector>

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
  EXPECT_EQ(read_documented_table(kRoot / "ARCHITECTURE.md"), read_layer_table(kRoot / "src/flank/layers.txt").written);
}

TEST(Layers, TheJudgeSeesNothingOfThePlanner) {
  const LayerTable table = read_layer_table(kRoot / "src/flank/layers.txt");
  const std::set<std::string> planner = {"surface", "motion", "envelope", "obstacle",    "seed",
                                         "fit",     "strip",  "cover",    "tool_choice", "trochoid"};
  std::set<std::string> met;
  for (const auto& [room, allowed] : table.rooms) {
    const std::string layer = layer_of(room);
    met.insert(layer);
    for (const std::string& other : allowed) {
      EXPECT_FALSE(layer == "verify" && planner.contains(layer_of(other))) << room << " sees " << other;
      EXPECT_FALSE(layer_of(other) == "verify" && planner.contains(layer)) << room << " sees " << other;
    }
  }
  for (const std::string& layer : planner) EXPECT_TRUE(met.contains(layer)) << layer;
  EXPECT_TRUE(met.contains("verify"));
}

/// A small tree of its own, removed at the end.
class PlantedTree : public ::testing::Test {
 protected:
  void SetUp() override {
    root_ = fs::path(::testing::TempDir()) / ("flank_layers_" + std::to_string(::getpid()));
    fs::remove_all(root_);
    write("src/flank/layers.txt", kTable);
    write("include/flank/point.h", "#pragma once\n#include <vector>\n#include <Eigen/Core>\nnamespace flank {}\n");
    write("include/flank/plan.h", "#pragma once\n#include \"flank/point.h\"\n");
    write("src/flank/low/a.h", "#pragma once\n#include \"flank/point.h\"\nnamespace flank::internal {}\n");
    write("src/flank/low/a.cpp", "#include \"flank/low/a.h\"\n");
    write("src/flank/low/point.cpp", "#include \"flank/point.h\"\n");
    write("src/flank/high/part/c.h", "#pragma once\n#include \"flank/plan.h\"\n#include \"flank/point.h\"\n");
    write("src/flank/high/b.h", "#pragma once\n#include \"flank/low/a.h\"\n#include <Eigen/Core>\n");
    write("src/flank/high/b.cpp", "#include \"flank/high/b.h\"\n#include \"flank/high/part/c.h\"\n");
    write("src/flank/io/read_occt.h", "#pragma once\n#include <TopoDS_Shape.hxx>\n#include \"flank/low/a.h\"\n");
    write("apps/tool/main.cpp", "#include \"commands.h\"\n#include \"flank/high/b.h\"\n");
    write("apps/tool/commands.h", "namespace flank::cli {}\n");
  }
  void TearDown() override { fs::remove_all(root_); }

  void write(const std::string& file, const std::string& text) {
    fs::create_directories((root_ / file).parent_path());
    std::ofstream(root_ / file) << text;
  }
  std::vector<std::string> violations() {
    return TreeCheck(root_, read_layer_table(root_ / "src/flank/layers.txt")).violations();
  }
  /// Expects exactly one violation, in `file`, that says `what`.
  void expect_one(const std::string& file, const std::string& what) {
    const std::vector<std::string> found = violations();
    ASSERT_EQ(found.size(), 1u) << what << "\n" << joined(found);
    EXPECT_TRUE(found.front().starts_with(file)) << found.front();
    EXPECT_NE(found.front().find(what), std::string::npos) << found.front();
  }
  /// The same after writing one file, which is then as it was before.
  void expect_found(const std::string& file, const std::string& text, const std::string& what) {
    std::string before;
    if (fs::exists(root_ / file)) before = joined(read_lines(root_ / file));
    write(file, text);
    expect_one(file, what);
    if (before.empty()) {
      fs::remove(root_ / file);
    } else {
      write(file, before);
    }
  }
  [[nodiscard]] LayerTable table_of(const std::string& text) {
    write("src/flank/other.txt", text);
    LayerTable table = read_layer_table(root_ / "src/flank/other.txt");
    fs::remove(root_ / "src/flank/other.txt");
    return table;
  }

  static constexpr const char* kTable =
      "# comment\n[rooms]\nlow:\nhigh/part: low\nhigh: low high/part\nio: low\nfar:\n"
      "[front door]\npoint: low\nplan: high\n";
  fs::path root_;
};

TEST_F(PlantedTree, IsCleanBeforeAnythingIsPlanted) { EXPECT_EQ(joined(violations()), ""); }

TEST_F(PlantedTree, FindsAnIncludeUpwards) {
  expect_found("src/flank/low/up.h", "#pragma once\n\n#include \"flank/high/b.h\"\n", ":3: low may not include high");
  expect_found("src/flank/low/up.h", "#pragma once\n#  include <flank/high/b.h>\n", "low may not include high");
}

TEST_F(PlantedTree, FindsAnIncludeOfAnotherRoomOfTheLayerThatIsNotListed) {
  expect_found("src/flank/high/part/d.h", "#pragma once\n#include \"flank/high/b.h\"\n",
               "high/part may not include high");
}

TEST_F(PlantedTree, FindsUnknownFolders) {
  expect_found("src/flank/utils/x.h", "#pragma once\n", "the folder utils is not in layers.txt");
  expect_found("src/flank/low/deep/x.h", "#pragma once\n", "the folder low/deep is not in layers.txt");
}

TEST_F(PlantedTree, FindsIncludesOfWhatIsNotThere) {
  expect_found("src/flank/high/c.h", "#pragma once\n#include \"flank/low/none.h\"\n", "there is no flank/low/none.h");
  expect_found("src/flank/high/c.h", "#pragma once\n#include \"flank/none.h\"\n", "there is no flank/none.h");
  expect_found("apps/tool/more.cpp", "#include \"flank/high/none.h\"\n", "there is no flank/high/none.h");
}

TEST_F(PlantedTree, FindsRelativeIncludes) {
  expect_found("src/flank/low/c.h", "#pragma once\n#include \"../high/b.h\"\n", "is not a path below src");
}

TEST_F(PlantedTree, ShowsTheFrontDoorOnlyToRoomsThatMayLookIntoItsLayer) {
  expect_found("src/flank/far/d.h", "#pragma once\n#include \"flank/plan.h\"\n",
               ":2: far may not include flank/plan.h of high");
}

TEST_F(PlantedTree, KeepsTheFrontDoorToItself) {
  expect_found("include/flank/plan.h", "#pragma once\n#include \"flank/low/a.h\"\n", "neither of the front door");
  expect_found("include/flank/plan.h", "#pragma once\n#include <fmt/core.h>\n", "neither of the front door");
  expect_found("include/flank/plan.h", "#pragma once\n#include \"plan.h\"\n", "neither of the front door");
  expect_found("include/flank/plan.h", "#pragma once\n#include \"flank/none.h\"\n", "there is no flank/none.h");
  expect_found("include/flank/plan.cpp", "#include \"flank/plan.h\"\n", "the front door has headers only");
  expect_found("include/flank/more.h", "#pragma once\n", "the header more is not in layers.txt");
}

TEST_F(PlantedTree, KeepsTheOrderOfTheLayersAtTheFrontDoor) {
  write("include/flank/plan.h", "#pragma once\n");
  expect_found("include/flank/point.h", "#pragma once\n#include \"flank/plan.h\"\n",
               "low may not include flank/plan.h of high");
}

TEST_F(PlantedTree, FindsAHeaderOfTheFrontDoorThatIsOnlyInTheTable) {
  write("src/flank/high/part/c.h", "#pragma once\n#include \"flank/point.h\"\n");
  fs::remove(root_ / "include/flank/plan.h");
  expect_one("src/flank/layers.txt", "there is no include/flank/plan.h");
}

TEST_F(PlantedTree, KeepsTheCadKernelInIo) {
  expect_found("src/flank/high/c_occt.h", "#pragma once\n#include <gp_Pnt.hxx>\n", "outside io");
  expect_found("apps/tool/more.cpp", "#include <gp_Pnt.hxx>\n", "outside io");
  expect_found("src/flank/io/part.h", "#pragma once\n#include <gp_Pnt.hxx>\n", "not named for it");
}

TEST_F(PlantedTree, KeepsThirdPartiesOutOfHeaders) {
  expect_found("src/flank/io/t.h", "#pragma once\n#include <nlohmann/json.hpp>\n", "not named for it");
  expect_found("src/flank/low/t.h", "#pragma once\n#include <fmt/core.h>\n", "in a header");
  expect_found("src/flank/low/a.cpp", "#include \"flank/low/a.h\"\n#include <tbb/parallel_for.h>\n",
               "use base/parallel.h");
}

TEST_F(PlantedTree, FindsHeadersWithoutAGuardOrOutOfOrder) {
  expect_found("src/flank/low/g.h", "int x();\n", "no #pragma once");
  expect_found("src/flank/low/a.cpp", "#include <vector>\n#include \"flank/low/a.h\"\n",
               "the first include is not flank/low/a.h");
  expect_found("src/flank/low/point.cpp", "#include \"flank/low/a.h\"\n", "the first include is not flank/point.h");
}

TEST_F(PlantedTree, FindsSourcesWithoutAHeaderOfTheirName) {
  expect_found("src/flank/low/alone.cpp", "\n", "there is no header alone.h");
  expect_found("src/flank/io/point.cpp", "#include \"flank/point.h\"\n", "there is no header point.h");
}

TEST_F(PlantedTree, FindsCirclesOfFiles) {
  write("src/flank/low/b.h", "#pragma once\n#include \"flank/low/a.h\"\n");
  expect_found("src/flank/low/a.h", "#pragma once\n#include \"flank/low/b.h\"\n",
               "a circle of files: src/flank/low/a -> src/flank/low/b -> src/flank/low/a");
}

TEST_F(PlantedTree, FindsCirclesThroughASource) {
  write("src/flank/low/b.h", "#pragma once\n#include \"flank/low/a.h\"\n");
  write("src/flank/low/a.cpp", "#include \"flank/low/a.h\"\n#include \"flank/low/b.h\"\n");
  expect_one("src/flank/low/a.h", "a circle of files");
}

TEST_F(PlantedTree, FindsCirclesOfTestsAndBenchmarks) {
  write("tests/low/s.h", "#include \"low/t.h\"\n");
  write("tests/low/t.h", "#include \"low/s.h\"\n");
  expect_one("tests/low/s.h", "a circle of files");
  fs::remove(root_ / "tests/low/s.h");
  write("bench/s.h", "#include \"t.h\"\n");
  write("bench/t.h", "#include \"s.h\"\n");
  expect_one("bench/s.h", "a circle of files");
}

TEST_F(PlantedTree, TakesNoSourceOfAFrontDoorHeaderForACircle) {
  write("src/flank/low/a.cpp", "#include \"flank/low/a.h\"\n#include \"flank/point.h\"\n");
  write("src/flank/low/point.cpp", "#include \"flank/point.h\"\n#include \"flank/low/a.h\"\n");
  EXPECT_EQ(joined(violations()), "");
}

// A circle of rooms needs a room that includes one of a later line, or one that its line does not name.
TEST_F(PlantedTree, FindsCirclesOfRooms) {
  EXPECT_THROW((void)table_of("[rooms]\nlow: high\nhigh: low\n"), std::runtime_error);
  EXPECT_THROW((void)table_of("[rooms]\nhigh/part: high\nhigh: high/part\n"), std::runtime_error);
  EXPECT_THROW((void)table_of("[rooms]\nhigh/part: high/*\nhigh:\n"), std::runtime_error);
  expect_found("src/flank/high/part/d.h", "#pragma once\n#include \"flank/high/b.h\"\n",
               "high/part may not include high");
}

TEST_F(PlantedTree, CountsWhatAppsIncludeBehindTheFrontDoor) {
  std::string text = "#include \"flank/high/b.h\"\n";
  for (int k = 1; k < kMostInternalIncludesOfApps; ++k) text += "#include \"flank/high/b.h\"\n";
  write("apps/tool/main.cpp", text);
  EXPECT_EQ(joined(violations()), "");
  write("apps/tool/main.cpp", text + "#include \"flank/point.h\"\n");
  EXPECT_EQ(joined(violations()), "");
  write("apps/tool/main.cpp", text + "#include \"flank/low/a.h\"\n");
  expect_one("apps:1:", "includes of internal headers");
  write("apps/tool/main.cpp", "#include \"flank/point.h\"\n");
  expect_found("examples/a.cpp", "#include \"flank/low/a.h\"\n", "is not of the front door");
}

TEST_F(PlantedTree, CountsTheLinesOfARoom) {
  std::string text = "#pragma once\n";
  const int there = static_cast<int>(read_lines(root_ / "src/flank/low/a.h").size() +
                                     read_lines(root_ / "src/flank/low/a.cpp").size() +
                                     read_lines(root_ / "src/flank/low/point.cpp").size());
  for (int k = there + 1; k < kMostLinesInARoom; ++k) text += "//\n";
  write("src/flank/low/long.h", text);
  EXPECT_EQ(joined(violations()), "");
  write("src/flank/low/long.h", text + "//\n");
  expect_one("src/flank/low:1:", std::to_string(kMostLinesInARoom + 1) + " lines");
}

TEST_F(PlantedTree, FindsWhatALineAllowsAndNobodyUses) {
  const auto with = [](const std::string& line, const std::string& other) {
    std::string table = kTable;
    return table.replace(table.find(line), line.size(), other);
  };
  write("src/flank/layers.txt", with("far:", "far: io"));
  EXPECT_EQ(joined(violations()), "") << "a room without a folder is still to come";
  write("src/flank/far/d.h", "#pragma once\n");
  expect_one("src/flank/layers.txt", "far may include io, and does not");
  write("src/flank/layers.txt", with("high: low high/part", "high: low high/*"));
  expect_one("src/flank/layers.txt", "high may include high/*, and includes one of them");
}

TEST_F(PlantedTree, CountsTheHeadersOfTheFrontDoor) {
  std::string table = kTable;
  for (int k = 2; k < kMostFrontDoorHeaders; ++k) {
    const std::string name = "h" + std::to_string(k);
    write("include/flank/" + name + ".h", "#pragma once\n");
    table += name + ": low\n";
  }
  write("src/flank/layers.txt", table);
  EXPECT_EQ(joined(violations()), "");
  write("src/flank/layers.txt", table + "more: low\n");
  write("include/flank/more.h", "#pragma once\n");
  expect_one("include/flank:1:", std::to_string(kMostFrontDoorHeaders + 1) + " headers");
}

TEST_F(PlantedTree, FindsForeignNamespacesInHeaders) {
  const std::string guard = "#pragma once\n";
  expect_found("src/flank/low/n.h", guard + "namespace flank {\n}\n", ":2: opens namespace flank;");
  expect_found("src/flank/low/n.h", guard + "namespace flank::internals {}\n", "opens namespace flank::internals");
  expect_found("src/flank/low/n.h", guard + "inline namespace {\n}\n", "without a name");
  expect_found("include/flank/plan.h", guard + "namespace flank::internal {}\n", "here it is flank");
  expect_found("apps/tool/commands.h", "namespace flank {}\n", "here it is flank::cli");
  write("src/flank/low/n.h", guard + "namespace flank::internal::low {\n}  // namespace {\nnamespace fs = std;\n");
  EXPECT_EQ(joined(violations()), "");
}

TEST_F(PlantedTree, ReadsWhatARoomMayInclude) {
  const LayerTable table =
      table_of("[rooms]\nlow:\nhigh/part: low\nhigh: high/*\ntop: high/part\nroof: high/*\n[front door]\nplan: high\n");
  EXPECT_EQ(table.rooms.at("top"), std::set<std::string>{"high/part"});
  EXPECT_EQ(table.rooms.at("roof"), (std::set<std::string>{"high", "high/part"}));
  EXPECT_EQ(table.written.at("roof"), std::set<std::string>{"high/*"});
  EXPECT_TRUE(table.sees("top", "high"));
  EXPECT_TRUE(table.sees("high/part", "high"));
  EXPECT_FALSE(table.sees("top", "low"));
}

TEST_F(PlantedTree, RefusesATableThatSaysNothingClear) {
  EXPECT_THROW((void)table_of("low:\n"), std::runtime_error);
  EXPECT_THROW((void)table_of("[rooms]\nlow\n"), std::runtime_error);
  EXPECT_THROW((void)table_of("[rooms]\nlow:\nlow:\n"), std::runtime_error);
  EXPECT_THROW((void)table_of("[rooms]\nlow:\n[front door]\npoint: high\n"), std::runtime_error);
  EXPECT_THROW((void)table_of("[rooms]\nlow:\nhigh:\n[front door]\npoint: low high\n"), std::runtime_error);
}

}  // namespace
}  // namespace flank::layers
