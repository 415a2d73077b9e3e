// report and view: the page of a folder.
#include <sys/stat.h>

#include "cli/cli_fixture.h"

namespace flank::cli {
namespace {

constexpr const char* kSummary = R"({"schema": "openflank/summary/1", "part": "blade.step", "faces": "F1"})";

class CliReport : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    write_file(root_ / "out/summary.json", kSummary);
    if (flank({"report", path("out")}).err.find("without the report page") != std::string::npos)
      GTEST_SKIP() << "built without the page; flank report says why";
  }
};

TEST_F(CliReport, WritesThePageIntoTheFolderOrElsewhere) {
  EXPECT_TRUE(fs::exists(root_ / "out/report.html"));
  const Outcome elsewhere = flank({"report", path("out"), "-o", path("page.html"), "--json"});
  EXPECT_EQ(elsewhere.exit_code, 0) << elsewhere.err;
  EXPECT_EQ(nlohmann::json::parse(elsewhere.out).at("files").at(0), path("page.html"));
  EXPECT_EQ(read_file(root_ / "page.html"), read_file(root_ / "out/report.html"));
}

TEST_F(CliReport, RefusesWrongFoldersAndSizes) {
  fs::remove_all(root_ / "out");
  fs::create_directories(root_ / "empty");
  expect_refused({"report", path("empty")}, 3, "contains none of");
  expect_refused({"report", path("nowhere")}, 3, "no such folder");
  write_file(root_ / "bad/verify.json", "nonsense");
  expect_refused({"report", path("bad")}, 3, "verify.json: not JSON");
  write_file(root_ / "good/summary.json", kSummary);
  expect_refused({"report", path("good"), "--png-size", "10x10"}, 2, "WIDTHxHEIGHT");
  expect_refused({"report", path("good"), "-o", path("nowhere/page.html")}, 3, "nowhere");
}

TEST_F(CliReport, SaysWhenThereIsNoBrowserForThePicture) {
  ::setenv("FLANK_BROWSER", "no-such-browser", 1);
  const Outcome outcome = flank({"report", path("out"), "--png", path("page.png")});
  ::unsetenv("FLANK_BROWSER");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.err.find("Chromium"), std::string::npos) << outcome.err;
  EXPECT_FALSE(fs::exists(root_ / "page.png"));
}

TEST_F(CliReport, ViewHandsThePageToTheDesktop) {
  const std::string opened = path("opened.txt"), opener = path("bin/xdg-open");
  write_file(opener, "#!/bin/sh\necho \"$1\" > " + opened + "\n");
  ::chmod(opener.c_str(), 0755);
  const std::string before = std::getenv("PATH");
  ::setenv("PATH", (path("bin") + ":" + before).c_str(), 1);
  const Outcome outcome = flank({"view", path("out")});
  ::setenv("PATH", before.c_str(), 1);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(read_file(opened), path("out/report.html") + "\n");
}

}  // namespace
}  // namespace flank::cli
