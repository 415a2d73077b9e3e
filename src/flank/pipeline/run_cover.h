/// What `flank cover` tells of a target that was covered.
#pragma once

#include "flank/pipeline/search/cover_groups.h"
#include "flank/run.h"

namespace flank::internal {

/// One target's figures, from the planner's.
[[nodiscard]] TargetCover summary_of(const Covered& covered);

}  // namespace flank::internal
