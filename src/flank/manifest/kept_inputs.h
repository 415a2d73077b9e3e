/// What a command that writes a result, and files of its own beside it, may not overwrite.
#pragma once

#include <string>
#include <vector>

#include "flank/base/kept/read_files.h"

namespace flank::internal {

/// Throws InputError if a result in this folder, its page or one of `own` (names in the folder) would overwrite one of these files: said
/// before the work, not after it.
void require_inputs_kept(const ReadFiles& inputs, const std::string& folder, const std::vector<std::string>& own);

}  // namespace flank::internal
