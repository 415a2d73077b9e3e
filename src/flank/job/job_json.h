/// job.json (schema "openflank/job/1"): what was asked for, so that `flank verify DIR` can judge what lies in the
/// folder.
#pragma once

#include <string>
#include <string_view>

#include "flank/pipeline/fit_job.h"

namespace flank::internal {

[[nodiscard]] std::string job_to_json(const FitJob& job);
/// Throws InputError naming the file and the key.
[[nodiscard]] FitJob job_from_json(const std::string& text, const std::string& file);

/// Makes the folder if it is not there and proves that it can be written. Throws InputError.
void ensure_folder(const std::string& folder);

}  // namespace flank::internal
