/// `flank design`: candidates, every one judged on every face, and the best set of them (docs/algorithms/design.md).
#pragma once

#include <string>

#include "flank/design/design_result.h"
#include "flank/progress.h"
#include "flank/sweep/task_batch.h"

namespace flank::internal {

/// Finds the set and writes design.json, design.csv and design.html into the folder, beside the folders of all fits, covers
/// and judgements. Throws UsageError and InputError before any work is done.
[[nodiscard]] DesignResult run_design(const DesignJob& job, const BatchRun& run, const Progress& progress);

}  // namespace flank::internal
