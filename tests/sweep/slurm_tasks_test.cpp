// What an element of a job array does: every line of the list once, whatever elements there are. The program is a shell.
#include "flank/sweep/slurm_tasks.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <utility>
#include <vector>

#include "temporary_folder.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

class SlurmElement : public TemporaryFolder {
 protected:
  /// A name that a shell must be told in quotes.
  SlurmElement() : TemporaryFolder("flank element's") {}

  /// Lines that each leave a mark of the element that ran them.
  void write_list(int count) {
    std::ofstream list(root_ / "list");
    for (int k = 0; k < count; ++k)
      list << fmt::format("echo $SLURM_ARRAY_TASK_ID >> \"{}\"\n", (root_ / fmt::format("ran{}", k)).string());
  }
  /// Lines of shells that do what is said, in their folders; the k-th leaves its exit code in "k.exit".
  void write_tasks(const std::vector<std::pair<std::string, fs::path>>& scripts, double timeout_s) {
    std::ofstream list(root_ / "list");
    for (std::size_t k = 0; k < scripts.size(); ++k) {
      const ChildTask task{{"-c", scripts[k].first}, scripts[k].second.string(), (root_ / "errors").string()};
      list << task_line("/bin/sh", task, (root_ / fmt::format("{}.exit", k)).string(), timeout_s) << "\n";
    }
  }
  void write_script(int count, int seconds) {
    std::ofstream(root_ / "script") << element_script((root_ / "list").string(), count, seconds);
  }
  /// The command that runs an element.
  [[nodiscard]] std::string element(int id, int first = 0) const {
    return fmt::format("SLURM_ARRAY_TASK_ID={} sh \"{}\" {}", id, (root_ / "script").string(), first);
  }
  static void run(const std::string& command) { ASSERT_EQ(std::system(command.c_str()), 0); }
  [[nodiscard]] std::string ran(int line) const { return content(fmt::format("ran{}", line)); }
};

TEST_F(SlurmElement, TakesALineAndRoundWhileThereIsTime) {
  write_list(5);
  write_script(5, 600);
  run(element(3));
  for (int k = 0; k < 5; ++k) EXPECT_EQ(ran(k), "3\n") << k;
  run(element(4));
  for (int k = 0; k < 5; ++k) EXPECT_EQ(ran(k), "3\n") << "line " << k << " was run twice";
}

TEST_F(SlurmElement, TakesOneLineAtLeastAndNoneOfAnother) {
  write_list(4);
  write_script(4, 0);
  run(element(1, 1));
  EXPECT_EQ(ran(2), "1\n");
  EXPECT_EQ(ran(3), "");
  run(element(2));
  EXPECT_EQ(ran(3), "2\n") << "its own was taken, the next is free";
  run(element(3));
  EXPECT_EQ(ran(0), "3\n");
}

TEST_F(SlurmElement, ManyAtOnceRunEachLineOnce) {
  write_list(60);
  write_script(60, 600);
  std::string all;
  for (int id = 0; id < 8; ++id) all += element(id) + " & ";
  run(all + "wait");
  for (int k = 0; k < 60; ++k) EXPECT_EQ(ran(k).size(), 2U) << k << ": " << ran(k);
}

TEST_F(SlurmElement, ATaskWritesItsExitCodeAndTheNextRunsFromItsOwnFolder) {
  fs::create_directories(root_ / "a");
  const std::string text = "printf 'two\nlines' > text; exit ";
  write_tasks({{text + "3", root_ / "a"}, {text + "4", root_}}, 0.0);
  write_script(2, 600);
  run(element(0));
  EXPECT_EQ(content("0.exit").substr(0, 2), "3 ");
  EXPECT_EQ(content("1.exit").substr(0, 2), "4 ");
  EXPECT_EQ(content("a/text"), "two\nlines");
  EXPECT_EQ(content("text"), "two\nlines");
}

TEST_F(SlurmElement, ATaskThatTakesTooLongDoesNotEndItsElement) {
  write_tasks({{"sleep 60", root_}, {"exit 0", root_}}, 0.5);
  write_script(2, 600);
  run(element(0));
  EXPECT_EQ(content("0.exit").substr(0, 4), "137 ");
  EXPECT_EQ(content("1.exit").substr(0, 2), "0 ");
}

// Its job is in the queue for as long as the shell runs: who waits for the job must not meet a task of it that still writes.
TEST_F(SlurmElement, ACancelledOneWaitsForItsTaskAndSaysNothingOfIt) {
  const std::string task =
      "trap 'sleep 0.5; echo ended > ended; exit 1' TERM; echo begun > begun; while :; do sleep 0.05; done";
  write_tasks({{task, root_}, {"echo next > next", root_}}, 0.0);
  write_script(2, 600);
  const std::string script = (root_ / "script").string();
  run("SLURM_ARRAY_TASK_ID=0 setsid sh \"" + script + "\" 0 & job=$!; cd \"" + root_.string() +
      "\"; until [ -e begun ]; do sleep 0.05; done; kill -TERM -$job; wait $job; [ $? = 143 ] && [ -e ended ]");
  EXPECT_EQ(content("0.exit"), "") << "it is a task that vanished, and is begun again";
  EXPECT_EQ(content("next"), "") << "nothing more is taken";
}

}  // namespace
}  // namespace flank::internal
