/// The floor of the channels, and what the flank leaves of the sides above it.
#pragma once

#include "flank/progress.h"
#include "flank/wheel/wheel_work.h"

namespace flank::internal {

/// The hub between the blades, by passes of the tool's tip sphere.
[[nodiscard]] WheelOperation floor_operation(WheelWork& work, const Progress& progress);

}  // namespace flank::internal
