// What a signal has stopped goes on with --resume, and ends with the same bytes; what cannot go on says why in one line.
#include "cli/stop_fixture.h"

namespace flank::cli {
namespace {

class CliResume : public StoppedCli {
 protected:
  void SetUp() override {
    StoppedCli::SetUp();
    if (kSanitized) GTEST_SKIP() << "a whole fit takes minutes under a sanitizer";
    part_ = make_cone();
  }

  [[nodiscard]] std::vector<std::string> fit_into(const std::string& folder,
                                                  const std::string& tolerance = "0.2") const {
    return {"fit",    part_,           "--face",   "F1", "--tolerance", tolerance,
            "--tool", "cone:radius=4", "--strips", "1",  "-o",          path(folder)};
  }

  [[nodiscard]] static std::vector<std::string> resumed(std::vector<std::string> words) {
    words.emplace_back("--resume");
    return words;
  }

  void expect_same(const std::string& a, const std::string& b) const {
    for (const char* name : {"path.json", "tool.json", "verify.json", "strips.step"})
      EXPECT_EQ(read_file(root_ / a / name), read_file(root_ / b / name)) << name;
  }

  std::string part_;
};

TEST_F(CliResume, AFitThatWasInterruptedGoesOn) {
  const Outcome whole = flank(fit_into("whole"));
  ASSERT_LE(whole.exit_code, 1) << whole.err;
  const Ended ended = stopped_at(fit_into("out"), "polish 2", SIGINT);
  ASSERT_TRUE(WIFEXITED(ended.status)) << ended.err;
  EXPECT_EQ(WEXITSTATUS(ended.status), 1) << ended.err;
  EXPECT_NE(ended.err.find("stopped by SIGINT; the best result so far is in"), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find("the same command with --resume continues"), std::string::npos) << ended.err;
  const auto manifest = nlohmann::json::parse(read_file(root_ / "out/manifest.json"));
  EXPECT_TRUE(manifest.at("files").contains("resume.json"));
  // Judged in between, it can still go on.
  EXPECT_LE(flank({"verify", path("out")}).exit_code, 1);
  const Outcome on = flank(resumed(fit_into("out")));
  EXPECT_EQ(on.exit_code, whole.exit_code) << on.err;
  expect_same("whole", "out");
  EXPECT_FALSE(fs::exists(root_ / "out/resume.json"));

  // Complete: nothing is left to do.
  const auto written = fs::last_write_time(root_ / "out/path.json");
  const Outcome again = flank(resumed(fit_into("out")));
  EXPECT_EQ(again.exit_code, whole.exit_code) << again.err;
  EXPECT_NE(again.out.find("nothing to do"), std::string::npos) << again.out;
  std::vector<std::string> as_json = resumed(fit_into("out"));
  as_json.emplace_back("--json");
  EXPECT_EQ(flank(as_json).out, read_file(root_ / "out/summary.json"));
  EXPECT_EQ(fs::last_write_time(root_ / "out/path.json"), written);
  const Outcome other = flank(resumed(fit_into("out", "0.3")));
  EXPECT_EQ(other.exit_code, 3);
  EXPECT_EQ(messages(other).size(), 1u) << other.err;
  EXPECT_NE(other.err.find("complete result of another job"), std::string::npos) << other.err;
}

/// A cover that reads a file of every kind and falls short of its request.
class CliFinished : public Cli {
 protected:
  void SetUp() override {
    Cli::SetUp();
    if (kSanitized)
      GTEST_SKIP() << "a whole cover takes minutes under a sanitizer; its parts are tested in tests/pipeline";
    words_ = {"cover",        make_side(), "--face",      "F1",        "--side",          "-",           "--tool",
              path("t.json"), "--holder",  path("h.txt"), "--fixture", path("vice.step"), "--tolerance", "2.5",
              "--strips",     "1",         "-o",          path("out"), "--clearance",     "500"};
    ASSERT_EQ(flank({"tool", "cylinder:radius=6", "--axis-length", "45", "-o", path("t.json")}).exit_code, 0);
    ASSERT_EQ(flank({"example", "ruled-blade", "-o", path("vice.step")}).exit_code, 0);
    write_file(root_ / "h.txt", "60 12\n90 12\n");
    const Outcome made = flank(words_);
    ASSERT_EQ(made.exit_code, 1) << made.err;
    words_.emplace_back("--resume");
  }
  std::vector<std::string> words_;
};

TEST_F(CliFinished, EndsAsTheRunThatMadeItAndOnlyWithTheSameFiles) {
  const Outcome again = flank(words_);
  EXPECT_EQ(again.exit_code, 1) << again.err << again.out;
  EXPECT_NE(again.out.find("does NOT meet the request"), std::string::npos) << again.out;
  const auto expect_refused_for = [&](const std::string& name) {
    SCOPED_TRACE(name);
    const Outcome outcome = flank(words_);
    EXPECT_EQ(outcome.exit_code, 3) << outcome.err << outcome.out;
    EXPECT_EQ(messages(outcome).size(), 1u) << outcome.err;
    EXPECT_NE(outcome.err.find(name), std::string::npos) << outcome.err;
  };
  // Another tool, holder or fixture; a file of the result that somebody edited.
  for (const std::string name : {"t.json", "h.txt", "vice.step", "out/path.json", "out/tool.json", "out/verify.json"}) {
    const std::string before = read_file(root_ / name);
    write_file(root_ / name, before + "\n");
    expect_refused_for(path(name));
    write_file(root_ / name, before);
  }
  // A manifest that does not say what was read.
  const std::string manifest = read_file(root_ / "out/manifest.json");
  auto without = nlohmann::json::parse(manifest);
  ASSERT_EQ(without.at("inputs").size(), 3u);
  without.erase("inputs");
  write_file(root_ / "out/manifest.json", without.dump());
  expect_refused_for("manifest.json");
  write_file(root_ / "out/manifest.json", manifest);
  EXPECT_EQ(flank(words_).exit_code, 1);
}

TEST_F(CliResume, AFolderWithoutStepsIsRefused) {
  expect_refused(resumed(fit_into("out")), 3, "nothing to resume");
  EXPECT_FALSE(fs::exists(root_ / "out")) << "the folder that it made is gone";
}

TEST_F(CliResume, OnlyTheSameJobOfTheSamePartGoesOn) {
  const Ended ended = stopped_at(fit_into("out"), "polish 2", SIGTERM);
  ASSERT_TRUE(fs::exists(root_ / "out/resume.json")) << ended.err;
  const std::string before = read_file(root_ / "out/resume.json");
  const auto expect_one_line = [&](const std::vector<std::string>& words, const std::string& why) {
    const Outcome outcome = flank(words);
    EXPECT_EQ(outcome.exit_code, 3) << outcome.err;
    EXPECT_EQ(messages(outcome).size(), 1u) << outcome.err;
    EXPECT_NE(outcome.err.find(why), std::string::npos) << outcome.err;
    EXPECT_EQ(read_file(root_ / "out/resume.json"), before) << "what is there stays";
  };
  expect_one_line(resumed(fit_into("out", "0.3")), "resume.json: is of another job");
  std::ofstream(part_, std::ios::app) << "\n";
  expect_one_line(resumed(fit_into("out")), "resume.json: is of another part");
  std::ofstream(root_ / "out/resume.json", std::ios::app) << " ";
  const Outcome changed = flank(resumed(fit_into("out")));
  EXPECT_EQ(changed.exit_code, 3);
  EXPECT_NE(changed.err.find("is not the file that manifest.json names"), std::string::npos) << changed.err;
}

}  // namespace
}  // namespace flank::cli
