/// What a job reads.
#pragma once

#include <string>
#include <vector>

#include "flank/job.h"

namespace flank::internal {

/// Every word of the job that may be the name of a file or folder: part, guide, fixtures, tool, holder, catalogue.
[[nodiscard]] std::vector<std::string> input_files(const PlanJob& job);

}  // namespace flank::internal
