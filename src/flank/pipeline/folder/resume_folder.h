/// What a folder of results holds for a run that goes on where an earlier one was stopped.
#pragma once

#include <memory>

#include "flank/base/journal.h"
#include "flank/job.h"
#include "flank/manifest/result_folder.h"

namespace flank::internal {

/// Whether the folder's result is complete and of this job and part, so that nothing is left to do. Throws InputError if it
/// is complete and of another one.
[[nodiscard]] bool is_finished(const ResultFolder& folder, const PlanJob& job);

/// The steps that are kept in it. Throws InputError: there are none, they are damaged, or not those that the manifest names.
[[nodiscard]] std::shared_ptr<Journal> journal_of(const ResultFolder& folder);

}  // namespace flank::internal
