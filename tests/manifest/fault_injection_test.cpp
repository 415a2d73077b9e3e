// Every call that changes the disk fails once, in turn, and the process is killed at each: what was there is whole, or
// what is new is, and the next command finds one of them.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "flank/error.h"
#include "flank/manifest/result_folder.h"
#include "sanitized.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;
using Files = std::map<std::string, std::string>;

const Files kOld{{"tool.json", "old tool"}, {"path.json", "old path"}, {"ranking.json", "old"}, {"report.html", "old"}};
const Files kNew{{"tool.json", "new tool"}, {"path.json", "new path"}, {"verify.json", "new verdict"}};

struct Outcome {
  int status = 0;  ///< of waitpid
  int calls = 0;
};

class Faults : public ::testing::Test {
 protected:
  void SetUp() override {
    if (kSanitized) GTEST_SKIP() << "the shim must be loaded first, and so must the sanitizer";
    root_ = fs::temp_directory_path() / ("faults_test-" + std::to_string(::getpid()));
    fs::remove_all(root_);
    fs::create_directories(root_);
  }
  void TearDown() override { fs::remove_all(root_); }

  [[nodiscard]] std::string folder() const { return (root_ / "out").string(); }

  void make_old() const {
    fs::remove_all(folder());
    ResultFolder(folder(), ResultFolder::Use::kWrite)
        .replace({kOld.begin(), kOld.end()},
                 {.made_by = "fit", .folder = folder(), .part = {}, .judged = {}, .inputs = {}, .files = {}});
    std::ofstream(root_ / "out/mine.txt") << "mine";
  }

  [[nodiscard]] Files files() const {
    Files found;
    for (const auto& entry : fs::directory_iterator(folder())) {
      std::ifstream in(entry.path(), std::ios::binary);
      found[entry.path().filename().string()] = {std::istreambuf_iterator<char>(in), {}};
    }
    EXPECT_EQ(found["mine.txt"], "mine");
    found.erase("mine.txt");
    found.erase(kManifestFile);
    return found;
  }

  [[nodiscard]] Outcome run(int at, const std::string& how) const {
    int ends[2];
    EXPECT_EQ(::pipe(ends), 0);
    std::vector<std::string> words{"LD_PRELOAD=" FLANK_FAULT_SHIM, "FLANK_FAULT_AT=" + std::to_string(at),
                                   "FLANK_FAULT_HOW=" + how, "FLANK_FAULT_COUNT=" + std::to_string(ends[1])};
    std::vector<char*> environment;
    for (std::string& word : words) environment.push_back(word.data());
    environment.push_back(nullptr);
    std::string program = FLANK_WRITE_FOLDER, name = folder();
    char* arguments[] = {program.data(), name.data(), nullptr};
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
    pid_t child = 0;
    EXPECT_EQ(::posix_spawn(&child, program.c_str(), &actions, nullptr, arguments, environment.data()), 0);
    posix_spawn_file_actions_destroy(&actions);
    ::close(ends[1]);
    Outcome outcome;
    EXPECT_EQ(::waitpid(child, &outcome.status, 0), child);
    if (::read(ends[0], &outcome.calls, sizeof outcome.calls) != sizeof outcome.calls) outcome.calls = 0;
    ::close(ends[0]);
    return outcome;
  }

  /// What the next command finds; "" if that is no whole result.
  [[nodiscard]] std::string state() const {
    const ResultFolder next(folder(), ResultFolder::Use::kWrite);
    next.require_whole();
    Files found = files();
    if (found == kOld) return "old";
    if (found == kNew) return "new";
    if (found.erase("report.html") == 1 && found == kNew) return "new with its page";
    return "";
  }

  fs::path root_;
};

TEST_F(Faults, WithoutAnyTheNewResultIsThere) {
  make_old();
  const Outcome outcome = run(0, "kill");
  EXPECT_EQ(outcome.status, 0);
  EXPECT_GT(outcome.calls, 30);
  EXPECT_EQ(files().count("report.html"), 1u);
  EXPECT_EQ(state(), "new with its page");
}

TEST_F(Faults, EveryCallFailsOnce) {
  make_old();
  const int calls = run(0, "kill").calls;
  for (const int error : {ENOSPC, EINTR})
    for (int at = 1; at <= calls; ++at) {
      SCOPED_TRACE(std::to_string(error) + " at " + std::to_string(at));
      make_old();
      const Outcome outcome = run(at, std::to_string(error));
      ASSERT_TRUE(WIFEXITED(outcome.status));
      const int code = WEXITSTATUS(outcome.status);
      const std::string found = state();
      EXPECT_TRUE(code == 3 ? !found.empty() : code == 0 && found == "new with its page") << code << ' ' << found;
    }
}

TEST_F(Faults, EveryCallIsTheLastThatWorks) {
  make_old();
  const int calls = run(0, "kill").calls;
  for (const int error : {ENOSPC, EROFS})
    for (int at = 1; at <= calls; ++at) {
      SCOPED_TRACE(std::to_string(error) + " from " + std::to_string(at));
      make_old();
      const Outcome outcome = run(at, "always " + std::to_string(error));
      ASSERT_TRUE(WIFEXITED(outcome.status));
      const std::string found = state();
      EXPECT_FALSE(found.empty());
      EXPECT_TRUE(WEXITSTATUS(outcome.status) == 3 || found == "new with its page") << found;
    }
}

TEST_F(Faults, KilledAtEveryCall) {
  make_old();
  const int calls = run(0, "kill").calls;
  for (const char* how : {"kill", "half"})
    for (int at = 1; at <= calls; ++at) {
      SCOPED_TRACE(std::string(how) + " at " + std::to_string(at));
      make_old();
      const Outcome outcome = run(at, how);
      ASSERT_TRUE(WIFSIGNALED(outcome.status) && WTERMSIG(outcome.status) == SIGKILL);
      EXPECT_NE(state(), "");
      for (const auto& entry : fs::directory_iterator(folder()))
        EXPECT_FALSE(entry.path().filename().string().starts_with(".flank")) << entry.path();
    }
}

}  // namespace
}  // namespace flank::internal
