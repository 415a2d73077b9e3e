/// What a folder of results was made from and is read for.
#pragma once

#include <string>

#include "flank/base/kept/read_files.h"

namespace flank::internal {

/// Every file that a command reads when it is given this folder: what the manifest names as read, what job.json names, and
/// job, tool, path and blank themselves. Nothing of what is not there; never throws for what is damaged, which is for those
/// to tell who need it.
[[nodiscard]] ReadFiles inputs_of_folder(const std::string& folder);

}  // namespace flank::internal
