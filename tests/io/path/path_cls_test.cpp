#include "flank/io/path/path_cls.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "flank/error.h"
#include "flank/io/path/path_cls_read.h"
#include "io/path/path_samples.h"

namespace flank::internal {
namespace {

Tool cone(double radius, double angle) {
  Tool tool;
  tool.radial = RadialFunction(ToolFamily::kCone, 20.0, Eigen::Vector2d(radius, angle));
  return tool;
}

std::string refusal(const std::string& text) {
  try {
    (void)path_from_cls(text, "p.cls");
  } catch (const InputError& e) {
    return e.what();
  }
  return "accepted";
}

TEST(PathCls, ReadsBackExactly) {
  const Path path = awkward_path();
  EXPECT_TRUE(same(path_from_cls(path_to_cls(path, cone(2, 0.05)), "p.cls"), path));
}

TEST(PathCls, HasItsWordsInOrderAndShortLines) {
  const std::string text =
      path_to_cls(awkward_path(), cone(2, 0.05), {"BLADE 1", "blade-tool.json", 4, 6000.0, 800.0, 25});
  std::size_t at = 0;
  for (const char* word : {"PARTNO BLADE 1\n", "UNITS/MM\n", "MULTAX/ON\n", "PPRINT TOOL PROFILE blade-tool.json\n",
                           "CUTTER/", "LOADTL/4\n", "SPINDL/6000.0000,CLW\n", "RAPID\n", "GOTO/",
                           "FEDRAT/800.0000,MMPM\n", "GOTO/", "SPINDL/OFF\n", "FINI\n"}) {
    const std::size_t found = text.find(word, at);
    ASSERT_NE(found, std::string::npos) << word;
    at = found + 1;
  }
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LE(line.size(), 72u) << line;
    const bool numbers = line.rfind("GOTO/", 0) == 0 || line.rfind("  ", 0) == 0;
    EXPECT_TRUE(!numbers || line.find('e') == std::string::npos) << "an exponent: " << line;
  }
}

TEST(PathCls, EntersAndLeavesAlongTheToolAxis) {
  Path path;
  path.strips.push_back({1, "flank", "F1", {{Vec3(1, 2, 3), Vec3(0, 1, 0)}, {Vec3(2, 2, 3), Vec3(0, 0, 1)}}});
  const std::string text = path_to_cls(path, cone(2, 0.05));
  EXPECT_NE(text.find("RAPID\nGOTO/1.0,52.0,3.0,0.0,1.0,0.0\nGOTO/1.0,2.0,3.0,"), std::string::npos) << text;
  EXPECT_NE(text.find("RAPID\nGOTO/2.0,2.0,53.0,0.0,0.0,1.0\nFINI"), std::string::npos) << text;
}

TEST(PathCls, InventsNeitherSpindleNorFeed) {
  const std::string text = path_to_cls(awkward_path(), cone(2, 0.05));
  for (const char* word : {"SPINDL/", "FEDRAT/"}) EXPECT_EQ(text.find(word), std::string::npos) << text;
  EXPECT_NE(text.find("PPRINT NO SPINDLE SPEED IS SET\nPPRINT NO FEED IS SET\n"), std::string::npos) << text;
}

TEST(PathCls, NearestCutterOfAConeIsTheCone) {
  const NearestCutter c = nearest_cutter(cone(2, 0.05));
  EXPECT_NEAR(c.side_angle, 0.05, 1e-12);
  EXPECT_NEAR(c.diameter, 2.0 * 2.0 / std::cos(0.05), 1e-12);
  EXPECT_DOUBLE_EQ(c.corner_radius, 2.0);
  EXPECT_NEAR(c.error_mm, 0.0, 1e-13);
  Tool barrel;
  barrel.radial = RadialFunction(ToolFamily::kBarrel, 20.0, Eigen::Vector3d(100, 5, 10));
  EXPECT_GT(nearest_cutter(barrel).error_mm, 0.2);
}

TEST(PathCls, ReadsOtherProgramsFiles) {
  const Path path = path_from_cls(
      "$$ made elsewhere\npartno/X\nUNITS/INCHES\nLOADTL/1\nRAPID\nGOTO/0,0,9\nFEDRAT/10,IPM\nGOTO / 1.0, 2, $\n 3\n"
      "GOTO/1,2,4, 0.7071,0,.7071 $$ tilted\nRAPID\nGOTO/0,0,9\nGOTO/5,5,5\nFINI\nGOTO/9,9,9\n",
      "p.cls");
  ASSERT_EQ(path.strips.size(), 2u);
  ASSERT_EQ(path.strips[0].poses.size(), 2u);
  EXPECT_EQ(path.strips[0].poses[0].tip, Vec3(25.4, 50.8, 3 * 25.4));
  EXPECT_EQ(path.strips[0].poses[0].axis, Vec3(0, 0, 1));
  EXPECT_NEAR(path.strips[0].poses[1].axis.norm(), 1.0, 1e-15);
  EXPECT_EQ(path.strips[1].poses.size(), 1u);
}

TEST(PathCls, BadFilesAreRefusedByLine) {
  const std::vector<std::pair<std::string, std::string>> corpus = {
      {"", "no GOTO"},
      {"solid cube\n", "no GOTO"},
      {"GOTO/1,2\n", "line 1: GOTO has 3 or 6"},
      {"UNITS/MM\nGOTO/1,2,x\n", "line 2: \"x\" is not a finite number"},
      {"GOTO/1,2,nan\n", "not a finite number"},
      {"GOTO/1,2,3,0,0,3\n", "length 3"},
      {"UNITS/FURLONGS\n", "expected MM or INCHES"},
      {"CIRCLE/0,0,0,0,0,1,5\n", "CIRCLE is not supported"},
      {"GOTO/1,2,3\nCYCLE/DRILL\n", "line 2: CYCLE"},
      {"GOTO/1,2,$\n", "ends within a statement"},
      {"PPRINT STRIP one flank\nGOTO/1,2,3\n", "whole number"},
      {"PPRINT STRIP 1 flank\nGOTO/1,2,3\nPPRINT STRIP 1 flank\n", "occurs twice"},
      {std::string("GOTO/1,2,3\0\n", 12), "is not text"}};
  for (const auto& [text, expected] : corpus) {
    const std::string message = refusal(text);
    EXPECT_EQ(message.rfind("p.cls: ", 0), 0u) << message;
    EXPECT_NE(message.find(expected), std::string::npos) << message << "\n for " << text;
  }
}

TEST(PathCls, OptionsThatMakeNoSenseAreRefused) {
  ClsOptions options;
  options.feed_mm_min = 0.0;
  EXPECT_THROW((void)path_to_cls(awkward_path(), cone(2, 0.05), options), UsageError);
}

}  // namespace
}  // namespace flank::internal
