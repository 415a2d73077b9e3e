// A signal stops every command soon, and what it leaves is whole and says what it is.
#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "cli/cli_fixture.h"

namespace flank::cli {
namespace {

using Clock = std::chrono::steady_clock;

/// A second is what is promised on a machine that does nothing else; tests run beside others, and the sanitizers are slow.
constexpr double kMostSeconds = kSanitized ? 120.0 : 15.0;

class CliStop : public Cli {
 protected:
  struct Ended {
    int status = 0;
    double seconds = 0.0;  ///< from the signal to the end; processor time of others counts
    std::string err;
  };

  /// Runs the command and sends it the signal once its messages hold `stage` (it may have ended before).
  [[nodiscard]] Ended stopped_at(const std::vector<std::string>& arguments, const std::string& stage,
                                 int signal) const {
    const std::string err = (root_ / "streams/stop.txt").string();
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, 1, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&files, 2, err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    std::vector<std::string> words = arguments;
    words.insert(words.begin(), FLANK_BINARY);
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    pid_t child = 0;
    EXPECT_EQ(posix_spawn(&child, FLANK_BINARY, &files, nullptr, argv.data(), environ), 0);
    posix_spawn_file_actions_destroy(&files);
    Ended ended;
    while (read_file(err).find(stage) == std::string::npos && ::waitpid(child, &ended.status, WNOHANG) == 0)
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    const auto begin = Clock::now();
    ::kill(child, signal);
    ::waitpid(child, &ended.status, 0);
    ended.seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    ended.err = read_file(err);
    return ended;
  }

  void expect_best_so_far(const Ended& ended, const std::string& signal) const {
    ASSERT_TRUE(WIFEXITED(ended.status)) << ended.err;
    EXPECT_EQ(WEXITSTATUS(ended.status), 1) << ended.err;
    EXPECT_NE(ended.err.find("stopped by " + signal), std::string::npos) << ended.err;
    EXPECT_LT(ended.seconds, kMostSeconds);
    if (ended.err.find("nothing was found yet") != std::string::npos) {
      EXPECT_FALSE(fs::exists(root_ / "out"));
      return;
    }
    const auto summary = nlohmann::json::parse(read_file(root_ / "out/summary.json"));
    EXPECT_FALSE(summary.at("complete").get<bool>());
    EXPECT_FALSE(summary.at("within").get<bool>());
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
  const std::vector<std::string> words{"fit",    make_blade(),        "--face",   "F1", "--tolerance", "0.1",
                                       "--tool", "cylinder:radius=4", "--strips", "1",  "-o",          path("out")};
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
  const std::vector<std::string> words{"fit",    make_blade(),        "--face",   "F1", "--tolerance", "0.2",
                                       "--tool", "cylinder:radius=4", "--strips", "1",  "-o",          path("out")};
  ASSERT_LE(flank(words).exit_code, 1);
  const std::string before = read_file(root_ / "out/path.json");
  const Ended ended = stopped_at(words, "read", SIGINT);
  ASSERT_TRUE(WIFEXITED(ended.status)) << ended.err;
  EXPECT_EQ(WEXITSTATUS(ended.status), 1) << ended.err;
  if (ended.err.find("nothing was found yet") != std::string::npos) {
    EXPECT_EQ(read_file(root_ / "out/path.json"), before);
  }
  EXPECT_TRUE(fs::exists(root_ / "out/manifest.json"));
}

TEST_F(CliStop, AVerifyEndsAndSaysSo) {
  if (kSanitized) GTEST_SKIP() << "a whole fit comes first, which takes minutes under a sanitizer";
  ASSERT_LE(flank({"fit", make_blade(), "--face", "F1", "--tolerance", "0.2", "--tool", "cylinder:radius=4", "--strips",
                   "1", "-o", path("out")})
                .exit_code,
            1);
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
