// Damaged path files: finite poses with unit axes, or a refusal that names file and line.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "flank/io/path/path_cls.h"
#include "flank/io/path/path_cls_read.h"
#include "flank/io/path/path_csv.h"
#include "flank/path_file.h"
#include "io/path/path_samples.h"
#include "mutations.h"

namespace flank::internal {
namespace {

Path small_path() {
  Path path = awkward_path();
  for (Strip& strip : path.strips) strip.poses.resize(5);
  return path;
}

/// Finite, of unit axes, every strip with poses and a number of its own.
bool sound(const Path& path) {
  std::set<int> ids;
  for (const Strip& strip : path.strips) {
    if (strip.poses.empty() || !ids.insert(strip.id).second) return false;
    for (const Pose& p : strip.poses)
      if (!p.tip.allFinite() || !(std::abs(p.axis.norm() - 1.0) <= kAxisLengthExact)) return false;
  }
  return true;
}

/// A refusal says "file: line n: ..." where it is about one line.
void expect_line(const std::string& text, Path (*read)(std::string_view, const std::string&), const char* line) {
  try {
    (void)read(text, "p.file");
    ADD_FAILURE() << text << " was accepted";
  } catch (const InputError& e) {
    EXPECT_EQ(std::string(e.what()).rfind(std::string("p.file: ") + line, 0), 0u) << e.what();
  }
}

Tool cylinder() {
  Tool tool;
  tool.radial = RadialFunction(ToolFamily::kCylinder, 20.0, Eigen::VectorXd::Constant(1, 3.0));
  return tool;
}

TEST(PathMutations, ClsIsReadOrRefused) {
  const MutationCount count = mutate(path_to_cls(small_path(), cylinder()), "p.cls", 1,
                                     [](const std::string& text) { return sound(path_from_cls(text, "p.cls")); });
  EXPECT_GT(count.read, kMutants / 10);
  EXPECT_GT(count.refused, kMutants / 10);
}

TEST(PathMutations, ClsOfAnotherProgramInInchesIsReadOrRefused) {
  const std::string text =
      "$$ made elsewhere\nPARTNO/X\nUNITS/INCHES\nLOADTL/1\nRAPID\nGOTO/0,0,9\nFEDRAT/10,IPM\nGOTO / 1.0, 2, $\n 3\n"
      "GOTO/1,2,4, 0.7071,0,.7071 $$ tilted\nRAPID\nGOTO/0,0,9\nGOTO/5,5,5\nPPRINT STRIP 3 flank "
      "F1\nGOTO/1,1,1\nFINI\n";
  const MutationCount count =
      mutate(text, "p.cls", 2, [](const std::string& t) { return sound(path_from_cls(t, "p.cls")); });
  EXPECT_GT(count.read, kMutants / 10);
  EXPECT_GT(count.refused, kMutants / 10);
}

TEST(PathMutations, CsvIsReadOrRefused) {
  Path path = small_path();
  path.strips[1].kind = "with \"quotes\"\nand, lines";
  const MutationCount count = mutate(path_to_csv(path), "p.csv", 3,
                                     [](const std::string& text) { return sound(path_from_csv(text, "p.csv")); });
  EXPECT_GT(count.read, kMutants / 20);
  EXPECT_GT(count.refused, kMutants / 10);
}

TEST(PathMutations, JsonIsReadOrRefused) {
  const MutationCount count = mutate(path_to_json(small_path()), "p.json", 4,
                                     [](const std::string& text) { return sound(path_from_json(text, "p.json")); });
  EXPECT_GT(count.read, kMutants / 20);
  EXPECT_GT(count.refused, kMutants / 10);
}

bool plain(const Path& path) {
  for (const Strip& strip : path.strips)
    for (const char c : strip.kind + strip.face)
      if (c < ' ' || c > '~') return false;
  return true;
}

TEST(PathMutations, WhatIsReadCanBeWrittenAndReadAgain) {
  for (const std::uint64_t seed : {5u, 6u}) {
    (void)mutate(path_to_cls(small_path(), cylinder()), "p.cls", seed, [](const std::string& text) {
      const Path path = path_from_cls(text, "p.cls");
      const Path again = path_from_json(path_to_json(path), "again");
      return !plain(path) || same(again, path);  // bytes that are no UTF-8 are replaced
    });
  }
}

TEST(PathMutations, ANumberThatOverflowsInMillimetresIsRefusedByItsLine) {
  expect_line("UNITS/INCHES\nGOTO/1,2,3\nGOTO/1e308,0,0\n", path_from_cls, "line 3: ");
  expect_line("UNITS/INCHES\nGOTO/1,2,-1.7e308\n", path_from_cls, "line 2: ");
}

TEST(PathMutations, AStripMayNotTakeTheNumberOfOneWithoutAName) {
  expect_line("GOTO/1,2,3\nPPRINT STRIP 1 flank\nGOTO/4,5,6\n", path_from_cls, "line 2: pass 1 (STRIP) occurs twice");
  const Path path = path_from_cls("GOTO/1,2,3\nPPRINT STRIP 2 flank\nGOTO/4,5,6\n", "p.cls");
  ASSERT_EQ(path.strips.size(), 2u);
  EXPECT_EQ(path.strips[0].id, 1);
  EXPECT_EQ(path.strips[1].id, 2);
}

}  // namespace
}  // namespace flank::internal
