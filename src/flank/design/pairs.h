/// Every candidate on every face.
#pragma once

#include "flank/design/candidates.h"

namespace flank::internal {

/// Fills `pairs`: each tool on each face, by the path of the fit that found it if that finishes the face, else by a cover
/// with it, else by a fit of the motion alone; on an equal face by the same path, moved, and where that does not finish
/// it by a fit of the motion from there, one from anywhere, and a cover of its own. All are judged where they are. Needs
/// `tools` and all before.
void judge_pairs(DesignResult& result, const DesignFolder& folder);

}  // namespace flank::internal
