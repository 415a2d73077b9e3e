// flank cover --tool catalogue and --tool FAMILY: the tool is chosen for the face.
#include <cmath>

#include "cli/cli_fixture.h"

namespace flank::cli {
namespace {

using nlohmann::json;

std::string tool_file(const std::string& family, const std::string& parameters, double length) {
  return R"({"schema": "openflank/tool/1", "units": "mm", "axis_length": )" + std::to_string(length) +
         R"(, "family": ")" + family + R"(", "parameters": )" + parameters + "}";
}

class CliCatalogue : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    write_file(root_ / "tools/long-cylinder.json", tool_file("cylinder", R"({"radius": 6})", 45.0));
    write_file(root_ / "tools/short-cylinder.json", tool_file("cylinder", R"({"radius": 4})", 16.0));
    write_file(root_ / "tools/tight-barrel.json", tool_file("barrel", R"({"arc": 30, "radius": 5, "s0": 10})", 20.0));
  }
  [[nodiscard]] std::vector<std::string> command(const std::string& tool, const std::string& folder) const {
    return {"cover", path("side.step"), "--side", "-", "--tolerance", "0.1", "--tool", tool, "-o", path(folder)};
  }
  [[nodiscard]] std::vector<std::string> rank(const std::string& folder) const {
    std::vector<std::string> arguments = command("catalogue", folder);
    arguments.insert(arguments.end(), {"--catalogue", path("tools"), "--finalists", "1"});
    return arguments;
  }
};

TEST_F(CliCatalogue, RanksAndWritesTheBest) {
  if (kSanitized) GTEST_SKIP() << "a whole search takes minutes under a sanitizer; its parts are tested one by one";
  (void)make_side();
  const Outcome cover = flank(rank("out"));
  ASSERT_EQ(cover.exit_code, 0) << cover.out << cover.err;
  EXPECT_NE(cover.out.find("3 tools: catalogue"), std::string::npos) << cover.out;
  EXPECT_NE(cover.out.find("tight-barrel"), std::string::npos) << cover.out;
  EXPECT_NE(cover.err.find("screen tools"), std::string::npos) << cover.err;
  const json ranking = json::parse(read_file(root_ / "out/ranking.json"));
  EXPECT_EQ(ranking.at("schema"), "openflank/ranking/1");
  const json& tools = ranking.at("tools");
  ASSERT_EQ(tools.size(), 3u);
  EXPECT_EQ(tools[0].at("tool"), "long-cylinder");
  EXPECT_EQ(tools[0].at("stage"), "full");
  EXPECT_GE(tools[0].at("coverage").get<double>(), 0.95);
  EXPECT_GT(tools[0].at("minutes").get<double>(), 0.0);
  EXPECT_FALSE(tools[2].at("works").get<bool>());
  EXPECT_NE(tools[2].at("reason").get<std::string>(), "");
  const json summary = json::parse(read_file(root_ / "out/summary.json"));
  EXPECT_EQ(summary.at("ranking"), tools);
  EXPECT_EQ(summary.at("axis_length"), 45.0);
  EXPECT_EQ(json::parse(read_file(root_ / "out/tool.json")).at("name"), "long-cylinder");
  EXPECT_EQ(flank({"verify", path("out")}).exit_code, 0);
}

TEST_F(CliCatalogue, SameBytesForOneAndTwoThreads) {
  if (kSanitized) GTEST_SKIP() << "a whole search takes minutes under a sanitizer; its parts are tested one by one";
  (void)make_side();
  for (const char* threads : {"1", "2"}) {
    std::vector<std::string> arguments = rank(std::string("out") + threads);
    arguments.insert(arguments.end(), {"--threads", threads, "--quiet"});
    ASSERT_EQ(flank(arguments).exit_code, 0);
  }
  for (const char* name : {"tool.json", "path.json", "ranking.json"})
    EXPECT_EQ(read_file(root_ / "out1" / name), read_file(root_ / "out2" / name)) << name;
}

TEST_F(CliCatalogue, SaysOfEveryToolWhyItCannotWork) {
  (void)make_side();
  fs::remove(root_ / "tools/long-cylinder.json");
  fs::remove(root_ / "tools/short-cylinder.json");
  write_file(root_ / "tools/thick.json", tool_file("barrel", R"({"arc": 60, "radius": 50, "s0": 20})", 45.0));
  const Outcome cover = flank(rank("out"));
  EXPECT_EQ(cover.exit_code, 1) << cover.err;
  EXPECT_NE(cover.out.find("none of 2 tools can machine this face"), std::string::npos) << cover.out;
  const json ranking = json::parse(read_file(root_ / "out/ranking.json"));
  for (const json& tool : ranking.at("tools")) {
    EXPECT_FALSE(tool.at("works").get<bool>());
    EXPECT_NE(tool.at("reason").get<std::string>().find(" mm"), std::string::npos) << tool;
  }
}

TEST_F(CliCatalogue, SearchesAFamily) {
  if (kSanitized) GTEST_SKIP() << "a whole search takes minutes under a sanitizer; its parts are tested one by one";
  (void)make_side();
  std::vector<std::string> arguments = command("cylinder", "out");
  arguments.insert(arguments.end(), {"--axis-length", "45", "--finalists", "1"});
  const Outcome cover = flank(arguments);
  ASSERT_EQ(cover.exit_code, 0) << cover.out << cover.err;
  EXPECT_NE(cover.out.find("axis 45 mm (given)"), std::string::npos) << cover.out;
  const json tool = json::parse(read_file(root_ / "out/tool.json"));
  EXPECT_EQ(tool.at("family"), "cylinder");
  EXPECT_EQ(tool.at("axis_length"), 45.0);
  const double radius = tool.at("parameters").at("radius");
  EXPECT_GE(radius, 2.0);
  EXPECT_NEAR(100.0 * radius, std::round(100.0 * radius), 1e-9) << "sensible digits";
}

TEST_F(CliCatalogue, RefusesWhatIsNoCatalogue) {
  (void)make_side();
  write_file(root_ / "tools/broken.json", "{\"schema\": \"openflank/tool/1\", \"axis_length\": 0}");
  expect_refused(rank("out"), 3, "broken.json");
  fs::remove_all(root_ / "tools");
  expect_refused(rank("out"), 3, "no such folder");
  fs::create_directories(root_ / "tools");
  expect_refused(rank("out"), 3, "no tool file in this folder");
}

TEST_F(CliCatalogue, RefusesWrongUsage) {
  (void)make_side();
  const auto refused = [&](std::vector<std::string> arguments, const std::vector<std::string>& more,
                           const std::string& what) {
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_refused(arguments, 2, what);
  };
  refused(rank("out"), {"--axis-length", "20"}, "--axis-length");
  refused(rank("out"), {"--finalists", "0"}, "--finalists");
  refused(rank("out"), {"--feed", "0"}, "--feed");
  refused(rank("out"), {"--rapid", "-1"}, "--rapid");
  refused(command("cylinder:radius=5", "out"), {"--axis-length", "20", "--catalogue", path("tools")}, "--catalogue");
}

}  // namespace
}  // namespace flank::cli
