// What each command does when all is well.
#include "cli/cli_fixture.h"

namespace flank::cli {
namespace {

using nlohmann::json;

/// First value of a key at any depth; null if there is none.
json find_key(const json& value, const std::string& key) {
  if (value.is_object() && value.contains(key)) return value.at(key);
  if (!value.is_structured()) return {};
  for (const json& child : value) {
    if (json found = find_key(child, key); !found.is_null()) return found;
  }
  return {};
}

TEST_F(Cli, InspectListsTheFaces) {
  const std::string blade = make_blade();
  const Outcome table = flank({"inspect", blade});
  EXPECT_EQ(table.exit_code, 0) << table.err;
  EXPECT_NE(table.out.find("F1"), std::string::npos);
  const Outcome summary = flank({"inspect", blade, "--json"});
  EXPECT_EQ(summary.exit_code, 0) << summary.err;
  const json parsed = json::parse(summary.out);
  ASSERT_TRUE(parsed.at("faces").is_array());
  ASSERT_FALSE(parsed.at("faces").empty());
  EXPECT_EQ(parsed.at("faces").at(0).at("id"), "F1");
}

// Open CASCADE's Booleans work on sets that are ordered by address, and addresses differ from process to process.
TEST_F(Cli, ExampleOfASolidIsTheSameBytesInEveryProcess) {
  for (const char* name : {"a.step", "b.step"}) {
    const Outcome made = flank({"example", "rotor37-blisk", "-o", path(name)});
    ASSERT_EQ(made.exit_code, 0) << made.err;
  }
  const std::string first = read_file(root_ / "a.step");
  EXPECT_GT(first.size(), 500000u);
  EXPECT_TRUE(first == read_file(root_ / "b.step"));
}

TEST_F(Cli, ToolIsWrittenWholeAndReadBack) {
  const Outcome made = flank(
      {"tool", "barrel", "--param", "arc=85", "--param", "radius=5", "--axis-length", "30", "-o", path("tool.json")});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const json tool = json::parse(read_file(root_ / "tool.json"));
  EXPECT_EQ(tool.at("schema"), "openflank/tool/1");
  EXPECT_EQ(tool.at("units"), "mm");
  EXPECT_EQ(tool.at("family"), "barrel");
  EXPECT_EQ(tool.at("axis_length"), 30.0);
  ASSERT_GE(tool.at("samples").size(), 201u);
  double largest = 0.0;
  for (const json& sample : tool.at("samples")) largest = std::max(largest, sample.at(1).get<double>());
  EXPECT_NEAR(largest, 5.0, 1e-9);
  EXPECT_EQ(tool.at("samples").back().at(0), 30.0);

  const Outcome converted = flank({"tool", path("tool.json"), "-o", path("tool.dxf")});
  EXPECT_EQ(converted.exit_code, 0) << converted.err;
  EXPECT_NE(read_file(root_ / "tool.dxf").find("ENTITIES"), std::string::npos);
}

TEST_F(Cli, RefusesIllegitimateTools) {
  const Outcome negative = flank({"tool", "cylinder", "--param", "diameter=-8", "-o", path("tool.json")});
  EXPECT_TRUE(negative.exit_code == 2 || negative.exit_code == 3) << negative.exit_code;
  EXPECT_FALSE(fs::exists(root_ / "tool.json"));
}

class CliFit : public Cli {
 protected:
  void SetUp() override {
    if (kSanitized)
      GTEST_SKIP() << "a whole fit takes minutes under a sanitizer; its parts are tested there one by one";
    Cli::SetUp();
  }
};

TEST_F(CliFit, FitsJudgesAndIsJudgedTheSameAgain) {
  const std::string blade = make_blade();
  const Outcome fit = flank({"fit", blade, "--face", "F1", "-o", path("out"), "--json"});
  ASSERT_TRUE(fit.exit_code == 0 || fit.exit_code == 1) << fit.exit_code << ' ' << fit.err;
  const json summary = json::parse(fit.out);
  ASSERT_TRUE(find_key(summary, "coverage").is_number()) << fit.out;
  EXPECT_GT(find_key(summary, "coverage").get<double>(), 0.9);
  for (const char* name : {"tool.json", "path.json", "path.cls", "tool.dxf", "tool.step", "tool.fctb", "strips.step",
                           "verify.json", "summary.json"}) {
    EXPECT_TRUE(fs::exists(root_ / "out" / name)) << name;
  }
  const json path_file = json::parse(read_file(root_ / "out/path.json"));
  EXPECT_EQ(path_file.at("schema"), "openflank/path/1");
  ASSERT_EQ(path_file.at("strips").size(), 1u);
  EXPECT_EQ(path_file.at("strips").at(0).at("face"), "F1");
  for (const json& pose : path_file.at("strips").at(0).at("poses")) {
    ASSERT_EQ(pose.size(), 6u);
    const double i = pose.at(3), j = pose.at(4), k = pose.at(5);
    EXPECT_NEAR(i * i + j * j + k * k, 1.0, 1e-9);
  }

  const json before = json::parse(read_file(root_ / "out/verify.json"));
  const Outcome verify = flank({"verify", path("out")});
  EXPECT_EQ(verify.exit_code, fit.exit_code) << verify.err;
  const json after = json::parse(read_file(root_ / "out/verify.json"));
  EXPECT_EQ(find_key(before, "coverage"), find_key(after, "coverage"));
  EXPECT_EQ(find_key(before, "overcut_mm"), find_key(after, "overcut_mm"));
}

TEST_F(CliFit, SameBytesForOneAndTwoThreads) {
  const std::string blade = make_blade();
  for (const char* threads : {"1", "2"}) {
    const Outcome fit = flank({"fit", blade, "--face", "F1", "--side", "+", "--tolerance", "0.1", "--threads", threads,
                               "--quiet", "-o", path(std::string("out") + threads)});
    ASSERT_TRUE(fit.exit_code == 0 || fit.exit_code == 1) << fit.exit_code << ' ' << fit.err;
  }
  for (const char* name : {"tool.json", "path.json", "path.cls", "tool.dxf", "tool.step", "tool.fctb", "strips.step"}) {
    EXPECT_EQ(read_file(root_ / "out1" / name), read_file(root_ / "out2" / name)) << name;
  }
}

// A tool far too thick for the tolerance is reported, not hidden: exit 1, and the files are there.
TEST_F(CliFit, SaysSoWhenItFallsShort) {
  const Outcome fit = flank({"fit", make_side(), "--face", "F1", "--side", "-", "--strips", "1", "--tool",
                             "cylinder:diameter=8", "--tolerance", "1e-4", "-o", path("out")});
  EXPECT_EQ(fit.exit_code, 1) << fit.err;
  EXPECT_TRUE(fs::exists(root_ / "out/verify.json"));
}

}  // namespace
}  // namespace flank::cli
