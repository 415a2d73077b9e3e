#include "flank/sweep/sweep.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "flank/base/atomic_file.h"
#include "flank/base/sha256.h"
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

/// A tool that is a file may change between two runs, and its name does not tell.
std::vector<BatchTask> batch_of(const SweepPlan& plan) {
  std::map<std::string, std::string> stamps;
  for (const std::string& tool : plan.tools)
    if (fs::is_regular_file(tool)) stamps[tool] = sha256(text_of_file(tool));
  std::vector<BatchTask> tasks;
  for (const SweepTask& task : plan.tasks) {
    const auto stamp = stamps.find(task.tool);
    tasks.push_back({task.name, task.words, stamp != stamps.end() ? stamp->second : std::string(), false});
  }
  return tasks;
}

}  // namespace

SweepResult run_sweep(const SweepPlan& plan, const BatchRun& run, const Progress& progress) {
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
