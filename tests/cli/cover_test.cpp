// flank cover: a folder like that of a fit, the same bytes for any number of threads, refusals.
#include "cli/cli_fixture.h"

namespace flank::cli {
namespace {

using nlohmann::json;

class CliCover : public Cli {
 protected:
  void SetUp() override {
    if (kSanitized)
      GTEST_SKIP() << "a whole search takes minutes under a sanitizer; its parts are tested there one by one";
    Cli::SetUp();
  }
  [[nodiscard]] std::vector<std::string> command(const std::string& folder) const {
    return {"cover",  make_side(), "--face",      "F1",  "--tool", "cylinder:radius=6", "--axis-length", "45",
            "--side", "-",         "--tolerance", "0.1", "-o",     path(folder)};
  }
};

TEST_F(CliCover, CoversAndIsJudgedTheSameAgain) {
  const Outcome cover = flank(command("out"));
  ASSERT_EQ(cover.exit_code, 0) << cover.out << cover.err;
  for (const char* name :
       {"tool.json", "path.json", "path.cls", "path.csv", "job.json", "verify.json", "view.json", "summary.json"})
    EXPECT_TRUE(fs::exists(root_ / "out" / name)) << name;
  const json summary = json::parse(read_file(root_ / "out/summary.json"));
  EXPECT_GE(summary.at("coverage").get<double>(), 0.97);
  EXPECT_LE(summary.at("strips").get<int>(), 10);
  EXPECT_LE(summary.at("overcut").get<double>(), 0.1);
  EXPECT_EQ(json::parse(read_file(root_ / "out/job.json")).at("command"), "cover");
  const Outcome verify = flank({"verify", path("out")});
  EXPECT_EQ(verify.exit_code, 0) << verify.err;
  EXPECT_NE(read_file(root_ / "out/view.json").find("flank cover side.step"), std::string::npos);
}

TEST_F(CliCover, SameBytesForOneAndTwoThreads) {
  for (const char* threads : {"1", "2"}) {
    std::vector<std::string> arguments = command(std::string("out") + threads);
    arguments.insert(arguments.end(), {"--threads", threads, "--quiet"});
    const Outcome cover = flank(arguments);
    ASSERT_EQ(cover.exit_code, 0) << cover.err;
  }
  for (const char* name : {"tool.json", "path.json", "path.cls"})
    EXPECT_EQ(read_file(root_ / "out1" / name), read_file(root_ / "out2" / name)) << name;
}

TEST_F(CliCover, SaysWhyAToolCannotWork) {
  const Outcome made = flank({"example", "elliptic-side", "-o", path("side.step")});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const Outcome cover = flank({"cover", path("side.step"), "--tool", "cylinder:radius=80", "--axis-length", "60",
                               "--side", "-", "--tolerance", "0.001", "-o", path("out")});
  EXPECT_EQ(cover.exit_code, 1) << cover.err;
  EXPECT_NE(cover.out.find("the concave face needs a tool radius below"), std::string::npos) << cover.out;
  EXPECT_NE(cover.out.find("no pass: nothing is machined"), std::string::npos) << cover.out;
  EXPECT_TRUE(json::parse(read_file(root_ / "out/summary.json")).at("undercut").is_null());
  const Outcome report = flank({"report", path("out")});
  EXPECT_TRUE(report.exit_code == 0 || report.err.find("Node.js") != std::string::npos) << report.err;
}

TEST_F(Cli, CoverRefusesWrongUsage) {
  const std::string blade = make_blade();
  const std::vector<std::string> cover = {"cover", blade, "-o", path("out")};
  const auto refused = [&](const std::vector<std::string>& more, const std::string& what) {
    std::vector<std::string> arguments = cover;
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_refused(arguments, 2, what);
  };
  const std::vector<std::string> tool = {"--tool", "cylinder:radius=5", "--axis-length", "20"};
  refused({}, "--tool");
  refused({"--tool", "free"}, "--tool");
  refused({"--tool", "cylinder:radius=5"}, "--axis-length");
  refused({"--tool", "power", "--axis-length", "20"}, "power");
  refused({"--tool", "barrel:radius=5", "--axis-length", "-20"}, "--axis-length");
  for (const auto& [option, value] : std::vector<std::pair<std::string, std::string>>{{"--tolerance", "0"},
                                                                                      {"--coverage", "2"},
                                                                                      {"--strips", "0"},
                                                                                      {"--strip-price", "-1"},
                                                                                      {"--seeds", "random"},
                                                                                      {"--strategy", "guess"}}) {
    std::vector<std::string> more = tool;
    more.insert(more.end(), {option, value});
    refused(more, option);
  }
  std::vector<std::string> unknown = tool;
  unknown.insert(unknown.end(), {"--strategy", "guess"});
  refused(unknown, "grow or curves");
}

}  // namespace
}  // namespace flank::cli
