// A signal stops every command soon, and what it leaves is whole and says what it is.
#include "cli/stop_fixture.h"

namespace flank::cli {
namespace {

/// A second is what is promised on a machine that does nothing else; tests run beside others, and the sanitizers are slow.
constexpr double kMostSeconds = kSanitized ? 120.0 : 15.0;

class CliStop : public StoppedCli {
 protected:
  [[nodiscard]] std::vector<std::string> small_fit() const {
    return {"fit", make_cone(), "--face",        "F1",       "--side", "+",  "--tolerance",
            "0.2", "--tool",    "cone:radius=4", "--strips", "1",      "-o", path("out")};
  }
  void expect_best_so_far(const Ended& ended, const std::string& signal) const {
    ASSERT_TRUE(WIFEXITED(ended.status)) << ended.err;
    EXPECT_EQ(WEXITSTATUS(ended.status), 1) << ended.err;
    EXPECT_NE(ended.err.find("stopped by " + signal), std::string::npos) << ended.err;
    EXPECT_LT(ended.seconds, kMostSeconds);
    if (ended.err.find("no result yet") != std::string::npos) {
      EXPECT_EQ(fs::exists(root_ / "out"), ended.err.find("the finished steps are in") != std::string::npos)
          << ended.err;
      return;
    }
    const auto summary = nlohmann::json::parse(read_file(root_ / "out/summary.json"));
    EXPECT_FALSE(summary.at("complete").get<bool>());
    EXPECT_FALSE(summary.at("within").get<bool>());
    // Either a verdict, or none: never figures that nobody has measured.
    EXPECT_EQ(summary.contains("judged"), summary.at("coverage").is_null());
    const auto verdict = nlohmann::json::parse(read_file(root_ / "out/verify.json"));
    EXPECT_FALSE(verdict.at("pass").get<bool>());
    // What was kept can be judged as any other result.
    const Outcome judged = flank({"verify", path("out")});
    EXPECT_TRUE(judged.exit_code == 0 || judged.exit_code == 1) << judged.err;
  }
};

TEST_F(CliStop, AFitKeepsTheBestSoFar) {
  const std::vector<std::string> words{"fit", make_blade(), "--face", "F1", "--tolerance", "0.01", "-o", path("out")};
  expect_best_so_far(stopped_at(words, "polish", SIGTERM), "SIGTERM");
}

TEST_F(CliStop, AFitThatIsJudgedDoesNotPass) {
  if (kSanitized) GTEST_SKIP() << "a whole fit comes first, which takes minutes under a sanitizer";
  const std::vector<std::string> words = small_fit();
  expect_best_so_far(stopped_at(words, "verify", SIGHUP), "SIGHUP");
}

TEST_F(CliStop, ACoverKeepsTheBestSoFar) {
  const std::vector<std::string> words{
      "cover",         make_blade(), "--face",      "F1",   "--tool", "barrel:arc=100,radius=5",
      "--axis-length", "20",         "--tolerance", "0.05", "-o",     path("out")};
  expect_best_so_far(stopped_at(words, "grow", SIGTERM), "SIGTERM");
}

TEST_F(CliStop, NothingTakesThePlaceOfAnEarlierResult) {
  if (kSanitized) GTEST_SKIP() << "a whole fit comes first, which takes minutes under a sanitizer";
  const std::vector<std::string> words = small_fit();
  ASSERT_LE(flank(words).exit_code, 1);
  const std::string before = read_file(root_ / "out/path.json");
  const Ended ended = stopped_at(words, "read", SIGINT);
  ASSERT_TRUE(WIFEXITED(ended.status)) << ended.err;
  EXPECT_EQ(WEXITSTATUS(ended.status), 1) << ended.err;
  if (ended.err.find("no result yet") != std::string::npos) {
    EXPECT_EQ(read_file(root_ / "out/path.json"), before);
  }
  EXPECT_TRUE(fs::exists(root_ / "out/manifest.json"));
}

TEST_F(CliStop, AVerifyEndsAndSaysSo) {
  if (kSanitized) GTEST_SKIP() << "a whole fit comes first, which takes minutes under a sanitizer";
  ASSERT_LE(flank(small_fit()).exit_code, 1);
  const std::string before = read_file(root_ / "out/path.json");
  const Ended ended = stopped_at({"verify", path("out")}, "", SIGTERM);
  // It may have ended, or not begun to listen, before.
  if (WIFSIGNALED(ended.status)) {
    EXPECT_EQ(WTERMSIG(ended.status), SIGTERM);
  }
  EXPECT_LT(ended.seconds, kMostSeconds);
  EXPECT_EQ(read_file(root_ / "out/path.json"), before);
  EXPECT_LE(flank({"verify", path("out")}).exit_code, 1);
}

}  // namespace
}  // namespace flank::cli
