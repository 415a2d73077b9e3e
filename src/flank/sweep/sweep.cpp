#include "flank/sweep/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "flank/base/atomic_file.h"
#include "flank/error.h"
#include "flank/io/text/json_dump.h"
#include "flank/manifest/result_folder.h"
#include "flank/report.h"
#include "flank/sweep/run_tasks.h"
#include "flank/sweep/tables.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTaskSchema = "openflank/sweep-task/1";

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The last line, without the name of the program before it.
std::string last_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  text.erase(0, text.rfind('\n') + 1);
  return text.starts_with("flank: ") ? text.substr(7) : text;
}

struct TaskFiles {
  fs::path folder, record, errors;
};
TaskFiles files_of(const SweepOptions& options, const SweepTask& task) {
  const fs::path root = fs::absolute(options.folder);
  return {root / task.name, root / (task.name + ".task.json"), root / (task.name + ".errors")};
}

TaskStatus status_of(const ChildOutcome& outcome) {
  if (outcome.timed_out) return TaskStatus::kTimedOut;
  if (outcome.failed()) return TaskStatus::kFailed;
  if (outcome.exit_code == 0) return TaskStatus::kMeets;
  return outcome.exit_code == 1 ? TaskStatus::kFallsShort : TaskStatus::kRefused;
}

/// What was asked for, and what came of it: a later run may keep it.
void write_record(const SweepPlan& plan, const SweepTask& task, const SweepRow& row, const fs::path& file) {
  const nlohmann::ordered_json json = {{"schema", kTaskSchema},
                                       {"words", task.words},
                                       {"part_sha256", plan.part_sha256},
                                       {"exit_code", row.exit_code},
                                       {"message", row.message}};
  write_file(file.string(), dumped(json, 2) + "\n");
}

/// Whether the folder holds a whole result of that part.
bool is_whole(const fs::path& folder, const SweepPlan& plan) {
  try {
    if (!fs::is_directory(folder)) return false;
    const ResultFolder held(folder.string(), ResultFolder::Use::kRead);
    held.require_whole();
    if (!held.manifest() || held.manifest()->part.sha256 != plan.part_sha256) return false;
    // A file that is missing is no other one, and not told by require_whole.
    const auto& files = held.manifest()->files;
    return std::all_of(files.begin(), files.end(),
                       [&](const auto& file) { return fs::is_regular_file(folder / file.first); });
  } catch (const Error&) {
    return false;
  }
}

/// The row of a task that an earlier run has done: the same words, the same part, and its result is whole.
std::optional<SweepRow> earlier(const SweepPlan& plan, const SweepTask& task, const TaskFiles& files) {
  const auto json = nlohmann::json::parse(text_of(files.record), nullptr, false);
  if (!json.is_object() || json.value("schema", "") != kTaskSchema) return {};
  const auto words = json.find("words"), code = json.find("exit_code");
  if (words == json.end() || *words != nlohmann::json(task.words) || code == json.end() || !code->is_number_integer())
    return {};
  if (json.value("part_sha256", "") != plan.part_sha256) return {};
  SweepRow row;
  row.exit_code = code->get<int>();
  row.status = status_of({row.exit_code, false});
  row.kept = true;
  const bool has_result = row.status == TaskStatus::kMeets || row.status == TaskStatus::kFallsShort;
  if (!has_result || !is_whole(files.folder, plan)) return {};
  return row;
}

double number(const nlohmann::json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_number() ? found->get<double>() : 0.0;
}

void read_figures(const fs::path& folder, SweepRow& row) {
  const auto json = nlohmann::json::parse(text_of(folder / "summary.json"), nullptr, false);
  if (!json.is_object()) return;
  SweepRow::Figures figures;
  figures.coverage = number(json, "coverage");
  figures.coverage_reachable = number(json, "coverage_reachable");
  figures.overcut_mm = number(json, "overcut");
  figures.undercut_mm = number(json, "undercut");
  figures.other_faces_overcut_mm = number(json, "other_faces_overcut");
  figures.strips = static_cast<int>(number(json, "strips"));
  figures.slenderness = number(json, "slenderness");
  row.figures = figures;
}

/// A task that has ended: its record, and its page if the library has one.
void finish_task(const SweepPlan& plan, const SweepTask& task, const TaskFiles& files, const ChildOutcome& outcome,
                 SweepRow& row) {
  row.status = status_of(outcome);
  row.exit_code = outcome.timed_out ? -1 : outcome.exit_code;
  const bool has_result = row.status == TaskStatus::kMeets || row.status == TaskStatus::kFallsShort;
  if (outcome.timed_out)
    row.message = fmt::format("took more than {:g} s", plan.timeout_s);
  else if (!has_result)
    row.message = last_line(text_of(files.errors));
  if (row.status == TaskStatus::kFailed && row.message.empty())
    row.message = fmt::format("ended with {}", row.exit_code);
  if (has_result && page_is_built()) (void)write_report(files.folder.string());
  write_record(plan, task, row, files.record);
  std::error_code ignored;
  fs::remove(files.errors, ignored);
}

std::vector<std::string> child_words(const SweepTask& task, const TaskFiles& files) {
  std::vector<std::string> words = task.words;
  // One core each: the tasks themselves are what runs in parallel.
  words.insert(words.end(), {"--quiet", "--threads", "1", "-o", files.folder.string()});
  return words;
}

}  // namespace

SweepResult run_sweep(const SweepPlan& plan, const SweepOptions& options, const Progress& progress) {
  std::error_code error;
  fs::create_directories(options.folder, error);
  if (!fs::is_directory(options.folder)) throw InputError(options.folder + ": is no folder and cannot be made");
  SweepResult result{plan, std::vector<SweepRow>(plan.tasks.size())};
  std::vector<std::size_t> open;
  std::vector<ChildTask> children;
  for (std::size_t k = 0; k < plan.tasks.size(); ++k) {
    const TaskFiles files = files_of(options, plan.tasks[k]);
    if (const auto row = options.resume ? earlier(plan, plan.tasks[k], files) : std::nullopt) {
      result.rows[k] = *row;
      continue;
    }
    // Until it has ended it is not done, whatever an earlier run has left.
    std::error_code ignored;
    fs::remove(files.record, ignored);
    open.push_back(k);
    children.push_back({child_words(plan.tasks[k], files), plan.folder(), files.errors.string()});
  }
  std::size_t ended = 0;
  const auto done = [&](std::size_t child, const ChildOutcome& outcome) {
    const std::size_t k = open[child];
    finish_task(plan, plan.tasks[k], files_of(options, plan.tasks[k]), outcome, result.rows[k]);
    progress.step(plan.tasks[k].name, static_cast<double>(++ended) / static_cast<double>(open.size()));
  };
  (void)run_tasks(options.program, children, {options.processes, plan.retries, plan.timeout_s}, done,
                  progress.cancelled);
  for (std::size_t k = 0; k < plan.tasks.size(); ++k) {
    SweepRow& row = result.rows[k];
    const fs::path folder = files_of(options, plan.tasks[k]).folder;
    std::error_code ignored;
    fs::remove(files_of(options, plan.tasks[k]).errors, ignored);
    if (row.status != TaskStatus::kMeets && row.status != TaskStatus::kFallsShort) continue;
    read_figures(folder, row);
    row.page = fs::is_regular_file(folder / "report.html");
  }
  const fs::path root(options.folder);
  write_file((root / "sweep.json").string(), sweep_json(result));
  write_file((root / "sweep.csv").string(), sweep_csv(result));
  write_file((root / "sweep.html").string(), sweep_html(result));
  return result;
}

}  // namespace flank::internal
