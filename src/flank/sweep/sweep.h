/// `flank sweep`: every task of a plan as a folder of results, and tables over all of them.
#pragma once

#include <string>

#include "flank/progress.h"
#include "flank/sweep/plan.h"
#include "flank/sweep/sweep_result.h"

namespace flank::internal {

struct SweepOptions {
  std::string program;  ///< whose commands do the tasks: this one's own file
  std::string folder;   ///< for all results; made if there is none
  int processes = 1;    ///< tasks at a time, >= 1; nothing but the time depends on it
  bool resume = false;  ///< tasks that an earlier run has done are kept
};

/// Runs a plan that read_plan has checked, and writes sweep.json, sweep.csv and sweep.html into the folder, beside a folder
/// of results and a NAME.task.json for each task. Stopped early it writes what is there. The same bytes for any number of
/// processes. Throws InputError if the folder cannot be written.
[[nodiscard]] SweepResult run_sweep(const SweepPlan& plan, const SweepOptions& options, const Progress& progress);

}  // namespace flank::internal
