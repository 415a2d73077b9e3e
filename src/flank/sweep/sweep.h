/// `flank sweep`: every task of a plan as a folder of results, and tables over all of them.
#pragma once

#include <string>

#include "flank/progress.h"
#include "flank/sweep/plan.h"
#include "flank/sweep/sweep_result.h"
#include "flank/sweep/task_batch.h"

namespace flank::internal {

/// Runs a plan that read_plan has checked, and writes sweep.json, sweep.csv and sweep.html into the folder, beside a folder
/// of results and a NAME.task.json for each task. Stopped early it writes what is there. The same bytes for any number of
/// processes. Throws InputError if the folder cannot be written.
[[nodiscard]] SweepResult run_sweep(const SweepPlan& plan, const BatchRun& run, const Progress& progress);

}  // namespace flank::internal
