// Child processes: order, retries, time limits, cancellation. The program is a shell.
#include "flank/sweep/run_tasks.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <filesystem>

#include "flank/error.h"
#include "temporary_folder.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;
constexpr const char* kShell = "/bin/sh";

class RunTasks : public TemporaryFolder {
 protected:
  RunTasks() : TemporaryFolder("flank_run_tasks") {}

  [[nodiscard]] ChildTask script(const std::string& text, const std::string& name = "task") const {
    return {{"-c", text}, root_.string(), (root_ / (name + ".errors")).string()};
  }
};

TEST_F(RunTasks, OutcomesStandInTheOrderOfTheTasks) {
  std::vector<ChildTask> tasks;
  for (int k = 0; k < 6; ++k) tasks.push_back(script("exit " + std::to_string(k % 4)));
  for (const int processes : {1, 3, 8}) {
    std::vector<std::size_t> ended;
    const auto outcomes = run_tasks(kShell, tasks, {processes, 0, 0.0},
                                    [&](std::size_t k, const ChildOutcome&) { ended.push_back(k); }, {});
    ASSERT_EQ(outcomes.size(), tasks.size());
    for (std::size_t k = 0; k < tasks.size(); ++k) EXPECT_EQ(outcomes[k].exit_code, static_cast<int>(k % 4));
    EXPECT_EQ(ended.size(), tasks.size());
  }
}

TEST_F(RunTasks, ATaskRunsInItsFolderAndItsErrorsAreKept) {
  const auto outcomes = run_tasks(kShell, {script("pwd >&2; echo told > here.txt")}, {}, {}, {});
  EXPECT_EQ(outcomes[0].exit_code, 0);
  EXPECT_EQ(content("here.txt"), "told\n");
  EXPECT_EQ(content("task.errors"), fs::canonical(root_).string() + "\n");
}

TEST_F(RunTasks, WhatFailedIsBegunAgainAsOftenAsIsAllowed) {
  // The third attempt succeeds.
  const ChildTask third = script("echo . >> count; test $(wc -l < count) -ge 3 || exit 4");
  EXPECT_EQ(run_tasks(kShell, {third}, {1, 1, 0.0}, {}, {})[0].exit_code, 4);
  EXPECT_EQ(content("count"), ".\n.\n");
  EXPECT_EQ(run_tasks(kShell, {third}, {1, 1, 0.0}, {}, {})[0].exit_code, 0);
  EXPECT_EQ(content("count"), ".\n.\n.\n");
}

TEST_F(RunTasks, ARefusalIsNoFault) {
  for (const int code : {0, 1, 2, 3}) {
    fs::remove(root_ / "count");
    const auto outcome =
        run_tasks(kShell, {script("echo . >> count; exit " + std::to_string(code))}, {1, 3, 0.0}, {}, {})[0];
    EXPECT_EQ(outcome.exit_code, code);
    EXPECT_FALSE(outcome.failed());
    EXPECT_EQ(content("count"), ".\n");
  }
  EXPECT_TRUE(run_tasks(kShell, {script("kill -SEGV $$")}, {}, {}, {})[0].failed());
}

TEST_F(RunTasks, WhatTakesTooLongIsEndedWithItsChildren) {
  const auto begin = std::chrono::steady_clock::now();
  const auto outcomes = run_tasks(kShell, {script("echo . >> count; sleep 60 & wait")}, {1, 1, 0.2}, {}, {});
  EXPECT_TRUE(outcomes[0].timed_out);
  EXPECT_TRUE(outcomes[0].failed());
  EXPECT_EQ(content("count"), ".\n.\n");
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30));
}

TEST_F(RunTasks, OnceCancelledNothingMoreIsBegun) {
  std::vector<ChildTask> tasks;
  for (int k = 0; k < 5; ++k) tasks.push_back(script("echo . >> count; sleep 0.1"));
  std::atomic<int> ended{0};
  const auto outcomes = run_tasks(
      kShell, tasks, {1, 0, 0.0}, [&](std::size_t, const ChildOutcome&) { ++ended; }, [&] { return ended >= 2; });
  EXPECT_EQ(ended, 2);
  EXPECT_EQ(outcomes[1].exit_code, 0);
  for (std::size_t k = 2; k < 5; ++k) EXPECT_EQ(outcomes[k].exit_code, -1);
}

TEST_F(RunTasks, AProgramThatIsNotThereIsAFault) {
  EXPECT_THROW((void)run_tasks("/nowhere/flank", {script("")}, {}, {}, {}), InternalError);
}

}  // namespace
}  // namespace flank::internal
