/// job.json (docs/schema/job.md, schema "openflank/job/1"): what was asked for, so that `flank verify DIR` can judge what
/// lies in the folder.
#pragma once

#include <string>

#include "flank/job.h"

namespace flank::internal {

/// Every field that is set, by its key in the table of fields. Files are written with absolute paths; names that are not
/// UTF-8 are encoded and read back as they were (base/file_name.h).
[[nodiscard]] std::string job_to_json(const PlanJob& job);

/// Throws InputError naming the file and the key: no JSON, another schema or command, a key that is missing or not known,
/// a value of the wrong type or out of its range.
[[nodiscard]] PlanJob job_from_json(const std::string& text, const std::string& file);

}  // namespace flank::internal
