// A sweep runs its tasks by a program, says what each ended with, and writes the same tables for any number of processes.
#include "flank/sweep/sweep.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "flank/base/atomic_file.h"
#include "flank/error.h"
#include "flank/example.h"
#include "flank/example/example_write.h"
#include "temporary_folder.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

class SweepTest : public TemporaryFolder {
 protected:
  SweepTest() : TemporaryFolder("flank_sweep") {}

  void SetUp() override {
    TemporaryFolder::SetUp();
    (void)write_example(make_example("ruled-blade"), (root_ / "blade.step").string());
    make_plan("plan.toml");
  }

  void make_plan(const std::string& name) {
    write_file((root_ / name).string(),
               "schema = \"openflank/sweep-plan/1\"\ncommand = \"cover\"\npart = \"" + (root_ / "blade.step").string() +
                   "\"\nfaces = [\"F1\"]\ntools = [\"cylinder:radius=5\", \"cylinder:radius=4\"]\n");
    plan_ = read_plan((root_ / name).string());
  }

  /// A stand-in for the command: it says this and ends with that.
  [[nodiscard]] std::string program(const std::string& message, int code) const {
    const fs::path file = root_ / "program.sh";
    write_file(file.string(), "#!/bin/sh\necho '" + message + "' >&2\nexit " + std::to_string(code) + "\n");
    fs::permissions(file, fs::perms::owner_all);
    return file.string();
  }

  [[nodiscard]] SweepResult sweep(const std::string& program, const std::string& folder, int processes = 1) const {
    BatchRun run;
    run.program = program;
    run.folder = (root_ / folder).string();
    run.processes = processes;
    return run_sweep(plan_, run, {});
  }

  SweepPlan plan_;
};

TEST_F(SweepTest, ARefusedTaskIsARowWithItsReason) {
  const SweepResult result = sweep(program("flank: no such tool", 3), "out");
  ASSERT_EQ(result.rows.size(), 2u);
  EXPECT_EQ(result.count(TaskStatus::kRefused), 2);
  EXPECT_TRUE(result.complete());
  EXPECT_FALSE(result.pass());
  EXPECT_EQ(result.rows[0].exit_code, 3);
  EXPECT_NE(result.rows[0].message.find("no such tool"), std::string::npos) << result.rows[0].message;
  EXPECT_FALSE(result.rows[0].figures);
  EXPECT_NE(content("out/sweep.csv").find("no such tool"), std::string::npos);
}

TEST_F(SweepTest, AProgramThatEndsWellWithoutAResultHasFailed) {
  const SweepResult result = sweep(program("", 0), "out");
  EXPECT_EQ(result.count(TaskStatus::kFailed), 2) << "no verdict was left";
}

TEST_F(SweepTest, TheTablesAreTheSameForAnyNumberOfProcesses) {
  const std::string stand_in = program("flank: refused", 3);
  (void)sweep(stand_in, "one", 1);
  (void)sweep(stand_in, "two", 2);
  for (const std::string table : {"sweep.json", "sweep.csv", "sweep.html"}) {
    EXPECT_FALSE(content("one/" + table).empty()) << table;
    EXPECT_EQ(content("one/" + table), content("two/" + table)) << table;
  }
}

TEST_F(SweepTest, APlanIsNotOverwrittenByATable) {
  fs::create_directories(root_ / "out");
  make_plan("out/sweep.csv");
  EXPECT_THROW((void)sweep(program("", 0), "out"), InputError);
  EXPECT_NE(content("out/sweep.csv").find("sweep-plan"), std::string::npos);
}

}  // namespace
}  // namespace flank::internal
