/// `flank bound`: what a tool cannot do on a face, proved (docs/algorithms/bound.md).
#pragma once

#include <string>

#include "flank/bound/bound_result.h"
#include "flank/bound/free_bound.h"
#include "flank/bound/part_map.h"
#include "flank/progress.h"

namespace flank::internal {

/// Reads the part and bounds every target. Throws UsageError and InputError before any work is done, Stopped without a point.
[[nodiscard]] BoundResult run_bound(const BoundJob& job, const Progress& progress);

/// Throws InputError if a file that the job reads would be overwritten by a result in this folder: to be asked before any work.
void require_inputs_kept(const BoundJob& job, const std::string& folder);

/// bound.json and bound.txt into the folder, which is made if there is none. Throws InputError, also for what the job reads.
void write_bound(const BoundResult& result, const std::string& folder);

}  // namespace flank::internal
