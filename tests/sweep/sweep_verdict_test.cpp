// The table of a sweep says what lies in the folders of its tasks, whatever exit code their records state: for every figure of the
// verdict, turned false alone. Nothing is run; the folders are there already.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "flank/base/atomic_file.h"
#include "flank/example.h"
#include "flank/example/example_write.h"
#include "flank/manifest/result_folder.h"
#include "flank/results/acceptance.h"
#include "flank/results/verify_json.h"
#include "flank/sweep/sweep.h"
#include "flank/sweep/tables.h"
#include "temporary_folder.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

class SweepVerdict : public TemporaryFolder {
 protected:
  SweepVerdict() : TemporaryFolder("flank_sweep_verdict") {}

  void SetUp() override {
    TemporaryFolder::SetUp();
    (void)write_example(make_example("ruled-blade"), (root_ / "blade.step").string());
    write_file((root_ / "plan.toml").string(),
               "schema = \"openflank/sweep-plan/1\"\ncommand = \"cover\"\npart = \"blade.step\"\nfaces = [\"F1\"]\n"
               "tools = [\"cylinder:radius=5\"]\n");
    plan_ = read_plan((root_ / "plan.toml").string());
  }

  /// What a task has left that ended with 0, with this verdict in its folder.
  void leave(const Acceptance& acceptance, bool complete = true) {
    const SweepTask& task = plan_.tasks.at(0);
    Manifest manifest;
    manifest.made_by = "cover";
    manifest.folder = (root_ / "out" / task.name).string();
    manifest.part = manifest.judged = {plan_.part, plan_.part_sha256};
    const nlohmann::json summary = {
        {"complete", complete}, {"coverage", 0.5}, {"coverage_reachable", 0.75}, {"strips", 2}};
    fs::create_directories(root_ / "out");
    ResultFolder folder((root_ / "out" / task.name).string(), ResultFolder::Use::kWrite);
    folder.replace({{"verify.json", verify_to_json({}, acceptance)}, {"summary.json", summary.dump()}}, manifest);
    const nlohmann::json record = {{"schema", "openflank/sweep-task/1"},
                                   {"words", task.words},
                                   {"part_sha256", plan_.part_sha256},
                                   {"exit_code", 0},
                                   {"message", ""}};
    write_file((root_ / "out" / (task.name + ".task.json")).string(), record.dump());
  }

  /// Nothing may be run: the program is none.
  [[nodiscard]] SweepResult swept() const {
    BatchRun run;
    run.program = (root_ / "no-such-program").string();
    run.folder = (root_ / "out").string();
    run.resume = true;
    return run_sweep(plan_, run, {});
  }

  SweepPlan plan_;
};

TEST_F(SweepVerdict, EveryFigureThatIsTurnedFalseIsNoInEveryTable) {
  leave({});
  const SweepResult sound = swept();
  EXPECT_TRUE(sound.pass());
  EXPECT_NE(sweep_text(sound).find("meets the request"), std::string::npos);
  for (const std::string_view name : kFigureNames) {
    SCOPED_TRACE(name);
    Acceptance no;
    no.reasons.push_back({std::string(name), "this is why"});
    leave(no);
    const SweepResult result = swept();
    EXPECT_FALSE(result.pass());
    EXPECT_EQ(result.rows.at(0).status, TaskStatus::kFallsShort);
    const auto json = nlohmann::json::parse(sweep_json(result));
    EXPECT_EQ(json.at("pass"), false);
    EXPECT_EQ(json.at("tasks").at(0).at("status"), "falls short");
    EXPECT_EQ(json.at("tasks").at(0).at("reasons").at(0), name);
    for (const std::string& table : {sweep_text(result), sweep_csv(result), sweep_html(result)}) {
      EXPECT_NE(table.find(name), std::string::npos) << table;
      EXPECT_EQ(table.find("meets the request"), std::string::npos) << table;
    }
  }
}

TEST_F(SweepVerdict, EveryCautionIsToldInEveryTable) {
  for (const std::string_view name : kFigureNames) {
    SCOPED_TRACE(name);
    Acceptance amber;
    amber.cautions.push_back({std::string(name), "mind this"});
    leave(amber);
    const SweepResult result = swept();
    EXPECT_TRUE(result.pass());
    for (const std::string& table : {sweep_text(result), sweep_csv(result), sweep_html(result), sweep_json(result)})
      EXPECT_NE(table.find(name), std::string::npos) << table;
  }
}

TEST_F(SweepVerdict, WorkThatWasInterruptedMeetsNothing) {
  leave({}, false);
  EXPECT_EQ(swept().rows.at(0).status, TaskStatus::kFallsShort);
}

TEST_F(SweepVerdict, BothSharesAreTold) {
  leave({});
  const SweepResult result = swept();
  for (const std::string& table : {sweep_text(result), sweep_html(result)}) {
    EXPECT_NE(table.find("75.00 %"), std::string::npos) << table;
    EXPECT_NE(table.find("50.00 % of the whole face"), std::string::npos) << table;
  }
}

}  // namespace
}  // namespace flank::internal
