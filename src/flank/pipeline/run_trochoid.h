/// What `flank trochoid` tells of a program that was planned.
#pragma once

#include "flank/run.h"
#include "flank/trochoid/program.h"

namespace flank::internal {

/// One layer's figures, from the planner's measures.
[[nodiscard]] LayerSummary summary_of(const PlannedLayer& planned);

}  // namespace flank::internal
