// flank design: refusals, and whole designs of small parts.
#include <nlohmann/json.hpp>

#include "cli/cli_fixture.h"
#include "sanitized.h"

namespace flank::cli {
namespace {

class DesignCli : public Cli {
 protected:
  /// Two walls of a channel: half a turn carries each into the other.
  [[nodiscard]] std::string make_channel() const {
    const std::string file = path("channel.step");
    EXPECT_EQ(flank({"example", "cavity", "-o", file, "--width", "40", "--depth", "20", "--length", "30"}).exit_code,
              0);
    return file;
  }
};

TEST_F(DesignCli, RefusesWhatCannotBeBeforeAnythingRuns) {
  const std::string part = make_channel();
  expect_refused({"design", part, "-o", path("out")}, 2, "--faces");
  expect_refused({"design", part, "--faces", "F1,F9", "-o", path("out")}, 3, "F9");
  expect_refused({"design", part, "--faces", "F1", "--tools", "0", "-o", path("out")}, 2, "--tools");
  expect_refused({"design", part, "--faces", "F1", "--source", "shop", "-o", path("out")}, 2, "--source");
  expect_refused({"design", part, "--faces", "F1", "--shape", "cylinder:radius=5", "-o", path("out")}, 2, "--shape");
  expect_refused(
      {"design", part, "--faces", "F1", "--source", "catalogue", "--catalogue", path("none"), "-o", path("out")}, 3,
      "none");
  EXPECT_FALSE(std::filesystem::exists(path("out")));
}

TEST_F(DesignCli, EqualFacesAreFittedOnceAndJudgedEach) {
  if (kSanitized) GTEST_SKIP() << "whole fits and covers; the parts are tested in tests/design";
  const std::string part = make_channel();
  const Outcome outcome =
      flank({"design", part, "--faces", "F1,F2", "--tools", "auto", "--tolerance", "0.2", "--json", "-o", path("out")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err << outcome.out;
  const auto design = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(design["schema"], "openflank/design/1");
  EXPECT_EQ(design["unfinished"], 0);
  ASSERT_EQ(design["tools"].size(), 1u);
  EXPECT_EQ(design["tools"][0]["source"], "fit of F1");
  ASSERT_EQ(design["pairs"].size(), 2u);
  EXPECT_EQ(design["faces"][1]["equal_to"], "F1");
  EXPECT_EQ(design["pairs"][1]["way"], "as F1");
  // The time is that of the paths, and a moved path takes as long.
  EXPECT_NEAR(design["pairs"][0]["minutes"].get<double>(), design["pairs"][1]["minutes"].get<double>(), 1e-9);
  EXPECT_NEAR(design["minutes"].get<double>(), 2.0 * design["pairs"][0]["minutes"].get<double>(), 1e-9);
  // Each was judged where it is.
  const auto verdict = nlohmann::json::parse(read_file(root_ / "out/F2-T1/verify.json"));
  EXPECT_EQ(verdict["pass"], true);
  EXPECT_EQ(verdict["coverage_reachable"], design["pairs"][1]["coverage_reachable"]);
  EXPECT_EQ(read_file(root_ / "out/tools/T1.json"), read_file(root_ / "out/fit-F1/tool.json"));
  EXPECT_EQ(read_file(root_ / "out/design.json"), outcome.out);
  EXPECT_NE(read_file(root_ / "out/design.csv").find("T1,fit of F1,F2,F1,meets the request,as F1,"), std::string::npos);
  // Again, with what is there: the same bytes, and nothing is done twice.
  const auto before = std::filesystem::last_write_time(root_ / "out/fit-F1/tool.json");
  const Outcome again = flank({"design", part, "--faces", "F1,F2", "--tools", "auto", "--tolerance", "0.2", "--json",
                               "--resume", "-o", path("out")});
  EXPECT_EQ(again.out, outcome.out);
  EXPECT_EQ(std::filesystem::last_write_time(root_ / "out/fit-F1/tool.json"), before);
}

}  // namespace
}  // namespace flank::cli
