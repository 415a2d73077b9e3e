/// `flank verify DIR`: judges the tool and the path that lie in a folder.
#pragma once

#include "flank/run.h"

namespace flank::internal {

/// Judges, and writes verify.json, view.json and, of a cavity's program, engagement.json to the folder, with its manifest.
/// Where the folder may not be written a note says so. Throws UsageError and InputError: also where tool, path and part are
/// not those that the result was made of.
[[nodiscard]] Verification judge_folder(const VerifyJob& request);

}  // namespace flank::internal
