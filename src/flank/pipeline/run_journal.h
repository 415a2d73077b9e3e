/// A run and its journal (base/journal.h): which job and part it is of, and when it is kept.
#pragma once

#include <string>
#include <vector>

#include "flank/base/journal.h"
#include "flank/job.h"
#include "flank/run.h"

namespace flank::internal {

/// The same, with an empty journal where there is none.
[[nodiscard]] Progress with_journal(const Progress& progress);

/// Every file or folder that the job names beside its part, as it is now, in the order of the fields. Words that name none
/// are left out.
[[nodiscard]] std::vector<InputStamp> input_stamps(const PlanJob& job);

/// What decides the steps of a job: all its fields but the name of the part, the files that they name, the part's bytes and
/// the version of the program.
[[nodiscard]] JournalKey journal_key(const PlanJob& job, const std::string& part_sha256);

}  // namespace flank::internal
