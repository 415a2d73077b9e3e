/// `flank post DIR`: the program with which a machine runs the path of a folder.
#pragma once

#include "flank/run.h"

namespace flank::internal {

/// The work of run_post (run.h).
[[nodiscard]] PostOutcome post_folder(const PostJob& request);

}  // namespace flank::internal
