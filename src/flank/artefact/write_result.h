/// A result into a folder that is held already (run.h has the same for a folder by its name).
#pragma once

#include "flank/manifest/result_folder.h"
#include "flank/run.h"

namespace flank::internal {

/// All files of run.h's write_result and their manifest, in the place of what was there. Throws InputError; what was
/// there is whole then.
void write_result(const Result& result, ResultFolder& folder);

}  // namespace flank::internal
