#include "flank/sweep/sweep.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "flank/base/atomic_file.h"
#include "flank/base/kept/read_files.h"
#include "flank/base/sha256.h"
#include "flank/job/input_files.h"
#include "flank/sweep.h"
#include "flank/sweep/tables.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

double number(const nlohmann::json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_number() ? found->get<double>() : 0.0;
}

/// The figures of a list of reasons or cautions, in its order, each once.
std::vector<std::string> figures_of(const nlohmann::json& json, const char* key) {
  std::vector<std::string> names;
  const auto list = json.find(key);
  if (list == json.end() || !list->is_array()) return names;
  for (const auto& one : *list) {
    const auto figure = one.is_object() ? one.find("figure") : one.end();
    if (!one.is_object() || figure == one.end() || !figure->is_string()) continue;
    if (std::find(names.begin(), names.end(), *figure) == names.end()) names.push_back(figure->get<std::string>());
  }
  return names;
}

void read_figures(const fs::path& folder, SweepRow& row) {
  const auto read = [&](const char* name) {
    return nlohmann::json::parse(text_of_file((folder / name).string()), nullptr, false);
  };
  const nlohmann::json json = read("summary.json"), verdict = read("verify.json");
  if (!json.is_object()) return;
  SweepRow::Figures figures;
  figures.coverage = number(json, "coverage");
  figures.coverage_reachable = number(json, "coverage_reachable");
  figures.overcut_mm = number(json, "overcut");
  figures.undercut_mm = number(json, "undercut");
  figures.other_faces_overcut_mm = number(json, "other_faces_overcut");
  figures.strips = static_cast<int>(number(json, "strips"));
  figures.slenderness = number(json, "slenderness");
  figures.reasons = figures_of(verdict.is_object() ? verdict : json, "reasons");
  figures.cautions = figures_of(verdict.is_object() ? verdict : json, "cautions");
  row.figures = figures;
}

/// A file that a task reads may change between two runs, and its name does not tell.
std::vector<BatchTask> batch_of(const SweepPlan& plan) {
  std::map<std::string, std::string> stamps;
  std::vector<BatchTask> tasks;
  for (const SweepTask& task : plan.tasks) {
    std::string all;
    for (const std::string& input : task.inputs) {
      if (!stamps.contains(input)) stamps[input] = hash_of_input(input);
      all += stamps[input];
    }
    tasks.push_back({task.name, task.words, all.empty() ? all : sha256(all), false});
  }
  return tasks;
}

ReadFiles inputs_of(const SweepPlan& plan) {
  ReadFiles files;
  files.add(plan.file, "as the plan");
  files.add(plan.part, "as the part");
  std::set<std::string> seen;
  for (const SweepTask& task : plan.tasks)
    for (const std::string& input : task.inputs)
      if (seen.insert(input).second) files.add(input, "by task " + task.name);
  return files;
}

}  // namespace

SweepResult run_sweep(const SweepPlan& plan, const BatchRun& run, const Progress& progress) {
  const ReadFiles inputs = inputs_of(plan);
  const Unwritten unwritten(inputs);
  for (const char* table : {"sweep.json", "sweep.csv", "sweep.html"})
    inputs.require_not_written((fs::path(run.folder) / table).string());
  const BatchOptions batch{.run = run,
                           .from = plan.folder(),
                           .part_sha256 = plan.part_sha256,
                           .retries = plan.retries,
                           .timeout_s = plan.timeout_s};
  SweepResult result{plan, {}};
  const fs::path root(run.folder);
  const std::vector<TaskRow> rows = run_batch(batch_of(plan), batch, progress);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    SweepRow& row = result.rows.emplace_back(SweepRow{rows[k], {}});
    if (row.has_result()) read_figures(root / plan.tasks[k].name, row);
  }
  write_file((root / "sweep.json").string(), sweep_json(result));
  write_file((root / "sweep.csv").string(), sweep_csv(result));
  write_file((root / "sweep.html").string(), sweep_html(result));
  return result;
}

}  // namespace flank::internal

namespace flank {

BatchOutcome run_sweep(const std::string& plan_file, const BatchRun& run, const Progress& progress) {
  const internal::SweepResult result = internal::run_sweep(internal::read_plan(plan_file), run, progress);
  return {result.pass(), internal::sweep_text(result), internal::sweep_json(result)};
}

}  // namespace flank
