// What verify and report say of folders whose files do not belong together, and what no command overwrites.
#include <fcntl.h>
#include <sys/file.h>

#include "cli/cli_fixture.h"

namespace flank::cli {
namespace {

using nlohmann::json;

/// Tool and path of another program, judged: the exact ones of an example.
class CliFolder : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    if (kSanitized)
      GTEST_SKIP() << "the command starts many times; tests/manifest and tests/pipeline do the same without it";
    ASSERT_EQ(flank({"example", "envelope-barrel-1", "-o", path("barrel.step")}).exit_code, 0);
    fs::create_directories(root_ / "out");
    fs::copy_file(root_ / "barrel.tool.json", root_ / "out/tool.json");
    fs::copy_file(root_ / "barrel.path.json", root_ / "out/path.json");
    const json job = {{"schema", "openflank/job/1"},
                      {"part", path("barrel.step")},
                      {"faces", "F1"},
                      {"tolerance", 0.1},
                      {"coverage", 0.1}};
    write_file(root_ / "out/job.json", job.dump());
    judged_ = flank({"verify", path("out")});
  }

  /// As if fit had made the folder.
  void pretend_fit() const {
    json manifest = json::parse(read_file(root_ / "out/manifest.json"));
    manifest["made_by"] = "fit";
    write_file(root_ / "out/manifest.json", manifest.dump());
  }
  void append(const std::string& name, const std::string& text) const {
    write_file(root_ / name, read_file(root_ / name) + text);
  }
  /// Exit 3 with one line that contains `what`, and no file of the folder changed.
  void expect_untouched(const std::vector<std::string>& arguments, const std::string& what) const {
    std::map<std::string, std::string> before, after;
    for (const auto& entry : fs::directory_iterator(root_ / "out")) before[entry.path()] = read_file(entry.path());
    const Outcome outcome = flank(arguments);
    EXPECT_EQ(outcome.exit_code, 3) << outcome.out;
    EXPECT_EQ(messages(outcome).size(), 1u) << outcome.err;
    EXPECT_NE(outcome.err.find(what), std::string::npos) << outcome.err;
    for (const auto& entry : fs::directory_iterator(root_ / "out")) after[entry.path()] = read_file(entry.path());
    EXPECT_EQ(before, after);
  }
  [[nodiscard]] bool has_page() const { return has_page(path("out")); }
  [[nodiscard]] bool has_page(const std::string& folder) const {
    return flank({"report", folder, "-o", path("page.html")}).err.find("without the report page") == std::string::npos;
  }

  Outcome judged_;
};

TEST_F(CliFolder, WhatOtherProgramsWroteIsJudgedWithANote) {
  EXPECT_EQ(judged_.exit_code, 0) << judged_.out << judged_.err;
  EXPECT_NE(judged_.out.find("no manifest.json"), std::string::npos) << judged_.out;
  EXPECT_EQ(json::parse(read_file(root_ / "out/manifest.json")).at("made_by"), "verify");
  // They may write again.
  append("out/path.json", "\n");
  EXPECT_EQ(flank({"verify", path("out")}).exit_code, 0);
}

TEST_F(CliFolder, AnOldVerdictBesideANewPathIsNotShown) {
  if (!has_page()) GTEST_SKIP() << "built without the page; flank report says why";
  append("out/path.json", "\n");
  expect_untouched({"report", path("out")}, "out/path.json");
  ASSERT_EQ(flank({"verify", path("out")}).exit_code, 0);
  EXPECT_EQ(flank({"report", path("out")}).exit_code, 0);
}

TEST_F(CliFolder, MixturesOfResultsAreRefusedByName) {
  pretend_fit();
  ASSERT_EQ(flank({"verify", path("out")}).exit_code, 0);
  EXPECT_EQ(json::parse(read_file(root_ / "out/manifest.json")).at("made_by"), "fit");
  for (const char* name : {"out/tool.json", "out/path.json", "out/job.json"}) {
    SCOPED_TRACE(name);
    const std::string before = read_file(root_ / name);
    append(name, "\n");
    expect_untouched({"verify", path("out")}, name);
    write_file(root_ / name, before);
  }
  write_file(root_ / "out/ranking.json", "{}");
  expect_untouched({"verify", path("out")}, "out/ranking.json");
}

TEST_F(CliFolder, APartThatHasChangedIsRefused) {
  pretend_fit();
  append("barrel.step", "\n");
  expect_untouched({"verify", path("out")}, "has changed");
  if (has_page()) expect_untouched({"report", path("out")}, "has changed");
  EXPECT_EQ(flank({"verify", path("out"), "--part", path("barrel.step")}).exit_code, 0) << "meant so";
}

TEST_F(CliFolder, MovesWithItsPart) {
  fs::create_directories(root_ / "new");
  fs::rename(root_ / "out", root_ / "new/out");
  EXPECT_EQ(flank({"verify", path("new/out")}).exit_code, 0) << "alone";
  fs::rename(root_ / "barrel.step", root_ / "new/barrel.step");
  for (int times = 0; times < 2; ++times) EXPECT_EQ(flank({"verify", path("new/out")}).exit_code, 0) << "together";
  fs::rename(root_ / "new", root_ / "newer");
  EXPECT_EQ(flank({"verify", path("newer/out")}).exit_code, 0) << "again";
  if (!has_page(path("newer/out"))) return;
  EXPECT_EQ(flank({"report", path("newer/out")}).exit_code, 0);
  append("newer/barrel.step", "\n");
  EXPECT_NE(flank({"report", path("newer/out")}).err.find("has changed"), std::string::npos);
}

TEST_F(CliFolder, InputsAndResultsAreNotOverwritten) {
  expect_untouched({"tool", path("out/tool.json"), "-o", path("out/tool.json")}, "out/tool.json");
  if (has_page()) {
    expect_untouched({"report", path("out"), "-o", path("out/verify.json")}, "out/verify.json");
    expect_untouched({"report", path("out"), "-o", path("out/../out/job.json")}, "job.json");
  }
  fs::copy_file(root_ / "barrel.step", root_ / "out/tool.step");
  expect_untouched({"fit", path("out/tool.step"), "--face", "F1", "-o", path("out")}, "out/tool.step");
  expect_untouched({"cover", path("barrel.step"), "--face", "F1", "--tool", path("out/tool.json"), "-o", path("out")},
                   "out/tool.json");
}

TEST_F(CliFolder, ALinkStaysALink) {
  write_file(root_ / "real.json", "x");
  fs::create_symlink("real.json", root_ / "link.json");
  EXPECT_EQ(flank({"tool", "cylinder:radius=3", "-o", path("link.json")}).exit_code, 0);
  EXPECT_TRUE(fs::is_symlink(root_ / "link.json"));
  EXPECT_GT(read_file(root_ / "real.json").size(), 10u);
  fs::remove(root_ / "out/tool.json");
  fs::create_symlink("../barrel.tool.json", root_ / "out/tool.json");
  expect_untouched({"verify", path("out")}, "out/tool.json");
}

TEST_F(CliFolder, TwoRunsIntoOneFolderAreOneTooMany) {
  const int folder = ::open(path("out").c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  ASSERT_EQ(::flock(folder, LOCK_EX), 0);
  expect_untouched({"verify", path("out")}, "another flank");
  expect_untouched({"fit", path("barrel.step"), "--face", "F1", "-o", path("out")}, "another flank");
  ::close(folder);
  EXPECT_EQ(flank({"verify", path("out")}).exit_code, 0);
}

TEST_F(CliFolder, JobFilesAreCheckedLikeTheCommandLine) {
  json job = json::parse(read_file(root_ / "out/job.json"));
  fs::remove(root_ / "out/manifest.json");
  for (const auto& [key, value] :
       {std::pair("coverage", json(0)), std::pair("coverage", json(-1)), std::pair("tolerance", json(-0.1)),
        std::pair("tolerance", json(0)), std::pair("part", json(7)), std::pair("sample", json(-1))}) {
    json wrong = job;
    wrong[key] = value;
    write_file(root_ / "out/job.json", wrong.dump());
    expect_untouched({"verify", path("out")}, key);
  }
}

TEST_F(CliFolder, APathOfAFaceThatThePartHasNotIsRefused) {
  json path_file = json::parse(read_file(root_ / "out/path.json"));
  path_file["strips"][0]["face"] = "F1,F99";
  write_file(root_ / "out/path.json", path_file.dump());
  expect_untouched({"verify", path("out")}, "F99");
}

}  // namespace
}  // namespace flank::cli
