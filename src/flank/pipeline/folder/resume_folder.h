/// What a folder of results holds for a run that goes on where an earlier one was stopped.
#pragma once

#include <memory>

#include "flank/base/journal.h"
#include "flank/job.h"
#include "flank/manifest/result_folder.h"
#include "flank/run.h"

namespace flank::internal {

/// Whether the folder's result is complete and of this job, part and `inputs` (the other files that the job reads, as they
/// are now), so that nothing is left to do. Throws InputError if it is complete and of others, or if one of its files was
/// edited or is gone.
[[nodiscard]] bool is_finished(const ResultFolder& folder, const PlanJob& job, const std::vector<InputStamp>& inputs);

/// Of a folder that is_finished: whether both the result, as it was made, and the verdict that lies in the folder meet
/// what was asked for.
[[nodiscard]] bool meets_request(const ResultFolder& folder);

/// The steps that are kept in it. Throws InputError: there are none, they are damaged, or not those that the manifest names.
[[nodiscard]] std::shared_ptr<Journal> journal_of(const ResultFolder& folder);

}  // namespace flank::internal
