/// Commands of this program as a batch: each a folder of results, kept by a later run where nothing has changed.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "flank/progress.h"
#include "flank/sweep.h"

namespace flank::internal {

/// One command whose result is a folder.
struct BatchTask {
  std::string name;                ///< of its folder, unique in the batch
  std::vector<std::string> words;  ///< of the command that does it, without -o
  std::string inputs;              ///< SHA-256 of what it reads beside the part; empty: nothing
  /// The folder is there already and is judged by the command (`verify`); false: the command makes it.
  bool judges = false;
};

/// A list of many faces makes a name that is longer than a file system takes: its end is told by a hash then.
[[nodiscard]] std::string short_name(const std::string& name);

enum class TaskStatus {
  kNotRun,      ///< the batch was stopped before
  kMeets,       ///< the verdict in its folder: it meets the request
  kFallsShort,  ///< there is a result, but it does not
  kRefused,     ///< wrong usage or refused input, found while it ran
  kFailed,      ///< it ended by a fault, in every attempt, or left no verdict
  kTimedOut,    ///< it took too long, in the last attempt
};
[[nodiscard]] std::string_view status_name(TaskStatus status);

/// What came out of a task.
struct TaskRow {
  TaskStatus status = TaskStatus::kNotRun;
  int exit_code = -1;
  std::string message;  ///< of a task without a result
  bool page = false;    ///< it has a report.html
  [[nodiscard]] bool has_result() const { return status == TaskStatus::kMeets || status == TaskStatus::kFallsShort; }
};

struct BatchOptions {
  BatchRun run;
  std::string from;         ///< folder in which the tasks run
  std::string part_sha256;  ///< of the part that they are about
  int retries = 0;          ///< how often a task that failed or took too long is begun again
  double timeout_s = 0.0;   ///< of an attempt; 0: none
};

/// Runs the tasks; row k is that of tasks[k]. Beside each folder NAME of results there is a NAME.task.json. The same
/// bytes for any number of processes. Throws InputError if the folder cannot be written.
[[nodiscard]] std::vector<TaskRow> run_batch(const std::vector<BatchTask>& tasks, const BatchOptions& options,
                                             const Progress& progress);

/// The content of a file; empty if it cannot be read.
[[nodiscard]] std::string text_of_file(const std::string& file);

}  // namespace flank::internal
