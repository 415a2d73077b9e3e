/// The operation of the sides of one sector.
#pragma once

#include "flank/progress.h"
#include "flank/wheel/wheel_work.h"

namespace flank::internal {

/// Both sides of the sector's blades, by one tool that is found or given: `fit`.
[[nodiscard]] WheelOperation side_operation(WheelWork& work, const Progress& progress);
}  // namespace flank::internal
