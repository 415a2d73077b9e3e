/// Tasks as child processes of one program, several at a time.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace flank::internal {

struct ChildTask {
  std::vector<std::string> words;  ///< of the program, without its name
  std::string folder;              ///< where it runs
  std::string errors;              ///< file for its standard error
};

struct ChildOutcome {
  int exit_code = -1;  ///< 128 + signal if a signal ended it; -1: it was not run
  bool timed_out = false;
  /// Whether another attempt could end otherwise: it took too long, a signal ended it, or it said that the fault is ours.
  [[nodiscard]] bool failed() const;
};

struct ChildLimits {
  int processes = 1;       ///< at a time, >= 1
  int retries = 0;         ///< how often a task that failed is begun again
  double timeout_s = 0.0;  ///< of an attempt; 0: none
};

/// Runs every task, in their order as processes become free; outcome[k] is that of tasks[k]. done(k, outcome) is called
/// once for each task that ended, in the order of their ends. Once cancelled() is true nothing more is begun, and what
/// runs is told to end (SIGTERM) and waited for. If this process is killed, so are children that are this program
/// (io/isolated/end_with_parent.h). Throws InternalError if the program cannot be started.
[[nodiscard]] std::vector<ChildOutcome> run_tasks(const std::string& program, const std::vector<ChildTask>& tasks,
                                                  const ChildLimits& limits,
                                                  const std::function<void(std::size_t, const ChildOutcome&)>& done,
                                                  const std::function<bool()>& cancelled);

}  // namespace flank::internal
