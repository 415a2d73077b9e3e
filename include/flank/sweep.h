/// `flank sweep`: fit or cover of many faces with many tools, each a folder of results, and tables over all of them.
#pragma once

#include <string>

#include "flank/progress.h"

namespace flank {

/// Who runs the tasks.
enum class BatchEngine { kLocal, kSlurm };

/// How a batch is run, as the user says.
struct BatchRun {
  std::string program;  ///< whose commands do the tasks: this one's own file
  std::string folder;   ///< for all results; made if there is none
  int processes = 1;    ///< tasks at a time, >= 1; nothing but the time depends on it
  BatchEngine engine = BatchEngine::kLocal;
  bool resume = false;  ///< tasks that an earlier run has done are kept
};

/// What came out of a batch.
struct BatchOutcome {
  bool pass = false;  ///< every task meets its request
  std::string table;  ///< for a terminal
  std::string json;   ///< of a sweep: docs/schema/sweep.md
};

/// Does what the plan says (docs/schema/sweep.md) and writes sweep.json, sweep.csv and sweep.html into the folder, beside a folder of
/// results and a NAME.task.json for each task. Stopped early it writes what is there. The same bytes for any number of processes.
/// Throws InputError before any work: no plan, or one of its tasks would be refused; and if the folder cannot be written.
[[nodiscard]] BatchOutcome run_sweep(const std::string& plan_file, const BatchRun& run, const Progress& progress = {});

}  // namespace flank
