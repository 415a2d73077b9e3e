#include "flank/sweep/task_batch.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "flank/base/atomic_file.h"
#include "flank/base/kept/read_files.h"
#include "flank/base/rest_of.h"
#include "flank/base/sha256.h"
#include "flank/error.h"
#include "flank/io/text/json_dump.h"
#include "flank/manifest/result_folder.h"
#include "flank/report.h"
#include "flank/sweep/run_tasks.h"
#include "flank/sweep/slurm_tasks.h"

namespace flank::internal {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTaskSchema = "openflank/sweep-task/1";

/// The last line, without the name of the program before it.
std::string last_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  text.erase(0, text.rfind('\n') + 1);
  return text.starts_with("flank: ") ? text.substr(7) : text;
}

struct TaskFiles {
  fs::path folder, record, errors;
};
TaskFiles files_of(const BatchOptions& options, const BatchTask& task) {
  const fs::path root = fs::absolute(options.run.folder);
  return {root / task.name, root / (task.name + ".task.json"), root / (task.name + ".errors")};
}

TaskStatus status_of(const ChildOutcome& outcome) {
  if (outcome.timed_out) return TaskStatus::kTimedOut;
  if (outcome.failed()) return TaskStatus::kFailed;
  if (outcome.exit_code == 0) return TaskStatus::kMeets;
  return outcome.exit_code == 1 ? TaskStatus::kFallsShort : TaskStatus::kRefused;
}

/// Whether the key is there and true.
bool says_yes(const nlohmann::json& json, const char* key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_boolean() && found->get<bool>();
}

/// The verdict that lies in a folder of results, whatever exit code a record states: that of verify.json, of work that was not
/// interrupted. kFailed: there is none.
TaskStatus verdict_in(const fs::path& folder) {
  const auto read = [&](const char* name) {
    return nlohmann::json::parse(text_of_file((folder / name).string()), nullptr, false);
  };
  const nlohmann::json verdict = read("verify.json"), summary = read("summary.json");
  if (!verdict.is_object() || !verdict.contains("pass")) return TaskStatus::kFailed;
  // A folder that was only judged has no summary: nothing was planned there that could be incomplete.
  const bool complete = !fs::exists(folder / "summary.json") || (summary.is_object() && says_yes(summary, "complete"));
  return complete && says_yes(verdict, "pass") ? TaskStatus::kMeets : TaskStatus::kFallsShort;
}

/// What was asked for, and what came of it: a later run may keep it.
void write_record(const BatchOptions& options, const BatchTask& task, const TaskRow& row, const fs::path& file) {
  nlohmann::ordered_json json = {{"schema", kTaskSchema}, {"words", task.words}, {"part_sha256", options.part_sha256}};
  if (!task.inputs.empty()) json["inputs_sha256"] = task.inputs;
  json["exit_code"] = row.exit_code;
  json["message"] = row.message;
  write_file(file.string(), dumped(json, 2) + "\n");
}

/// Whether the folder holds a whole result of that part.
bool is_whole(const fs::path& folder, const std::string& part_sha256) {
  try {
    if (!fs::is_directory(folder)) return false;
    const ResultFolder held(folder.string(), ResultFolder::Use::kRead);
    held.require_whole();
    if (!held.manifest() || held.manifest()->part.sha256 != part_sha256) return false;
    // A file that is missing is no other one, and not told by require_whole.
    const auto& files = held.manifest()->files;
    return std::all_of(files.begin(), files.end(),
                       [&](const auto& file) { return fs::is_regular_file(folder / file.first); });
  } catch (const Error&) {
    return false;
  }
}

/// The row of a task that an earlier run has done: the same words, part and inputs, and its result is whole.
std::optional<TaskRow> earlier(const BatchOptions& options, const BatchTask& task) {
  const TaskFiles files = files_of(options, task);
  const auto json = nlohmann::json::parse(text_of_file(files.record.string()), nullptr, false);
  if (!json.is_object() || json.value("schema", "") != kTaskSchema) return {};
  const auto words = json.find("words"), code = json.find("exit_code");
  if (words == json.end() || *words != nlohmann::json(task.words) || code == json.end() || !code->is_number_integer())
    return {};
  if (json.value("part_sha256", "") != options.part_sha256 || json.value("inputs_sha256", "") != task.inputs) return {};
  TaskRow row;
  row.exit_code = code->get<int>();
  row.status = status_of({row.exit_code, false});
  if (!row.has_result() || !is_whole(files.folder, options.part_sha256)) return {};
  row.status = verdict_in(files.folder);
  if (!row.has_result()) return {};
  row.page = fs::is_regular_file(files.folder / "report.html");
  return row;
}

/// A task that has ended: its record, and its page if the library has one.
TaskRow finished(const BatchOptions& options, const BatchTask& task, const ChildOutcome& outcome) {
  const TaskFiles files = files_of(options, task);
  TaskRow row;
  row.status = status_of(outcome);
  row.exit_code = outcome.timed_out ? -1 : outcome.exit_code;
  if (row.has_result()) row.status = verdict_in(files.folder);
  if (outcome.timed_out)
    row.message = fmt::format("took more than {:g} s", options.timeout_s);
  else if (!row.has_result())
    row.message = last_line(text_of_file(files.errors.string()));
  if (row.status == TaskStatus::kFailed && row.message.empty())
    row.message = fmt::format("ended with {}{}", row.exit_code, outcome.failed() ? "" : " and wrote no verdict");
  if (row.has_result() && page_is_built()) (void)write_report(files.folder.string());
  row.page = row.has_result() && fs::is_regular_file(files.folder / "report.html");
  write_record(options, task, row, files.record);
  std::error_code ignored;
  fs::remove(files.errors, ignored);
  return row;
}

/// Each task knows what it reads itself, but not what the batch reads.
void require_results_unread(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) return;
  for (const std::string& name : result_names()) require_unread((folder / name).string());
  require_unread((folder / kPageFile).string());
}

std::vector<std::string> child_words(const BatchTask& task, const TaskFiles& files) {
  std::vector<std::string> words = task.words;
  // One core each: the tasks themselves are what runs in parallel.
  words.insert(words.end(), {"--quiet", "--threads", "1"});
  if (!task.judges) words.insert(words.end(), {"-o", files.folder.string()});
  return words;
}

}  // namespace

std::string short_name(const std::string& name) {
  constexpr std::size_t kMost = 180, kDigits = 16;
  if (name.size() <= kMost) return name;
  return name.substr(0, kMost - kDigits - 1) + "-" + sha256(name).substr(0, kDigits);
}

std::string_view status_name(TaskStatus status) {
  switch (status) {
    case TaskStatus::kNotRun:
      return "not run";
    case TaskStatus::kMeets:
      return "meets the request";
    case TaskStatus::kFallsShort:
      return "falls short";
    case TaskStatus::kRefused:
      return "refused";
    case TaskStatus::kFailed:
      return "failed";
    case TaskStatus::kTimedOut:
      return "timed out";
  }
  return "";
}

std::string text_of_file(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  return rest_of(stream);
}

std::vector<TaskRow> run_batch(const std::vector<BatchTask>& tasks, const BatchOptions& options,
                               const Progress& progress) {
  std::error_code error;
  fs::create_directories(options.run.folder, error);
  if (!fs::is_directory(options.run.folder))
    throw InputError(options.run.folder + ": is not a folder and cannot be created");
  for (const BatchTask& task : tasks) require_results_unread(files_of(options, task).folder);
  std::vector<TaskRow> rows(tasks.size());
  std::vector<std::size_t> open;
  std::vector<ChildTask> children;
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    if (const auto row = options.run.resume ? earlier(options, tasks[k]) : std::nullopt) {
      rows[k] = *row;
      continue;
    }
    // Until it has ended it is not done, whatever an earlier run has left.
    const TaskFiles files = files_of(options, tasks[k]);
    std::error_code ignored;
    require_unread(files.record.string());
    require_unread(files.errors.string());
    fs::remove(files.record, ignored);
    open.push_back(k);
    children.push_back({child_words(tasks[k], files), options.from, files.errors.string()});
  }
  std::size_t ended = 0;
  const auto done = [&](std::size_t child, const ChildOutcome& outcome) {
    const std::size_t k = open[child];
    rows[k] = finished(options, tasks[k], outcome);
    progress.step(tasks[k].name, static_cast<double>(++ended) / static_cast<double>(open.size()));
  };
  const ChildLimits limits{options.run.processes, options.retries, options.timeout_s};
  if (options.run.engine == BatchEngine::kSlurm)
    (void)slurm_tasks(options.run.program, children, limits, (fs::path(options.run.folder) / ".slurm").string(), done,
                      progress.cancelled);
  else
    (void)run_tasks(options.run.program, children, limits, done, progress.cancelled);
  for (const BatchTask& task : tasks) {
    std::error_code ignored;
    fs::remove(files_of(options, task).errors, ignored);
  }
  return rows;
}

}  // namespace flank::internal
