/// The floor of the channels, and what the flank leaves of the sides above it.
#pragma once

#include "flank/progress.h"
#include "flank/wheel/point/channel.h"
#include "flank/wheel/wheel_work.h"

namespace flank::internal {

/// A channel with all that a tool meets in it. It must not outlive the work.
[[nodiscard]] FloorChannel floor_channel(WheelWork& work, const SectorChannel& channel);

/// The hub between the blades, by passes of the tool's tip sphere.
[[nodiscard]] WheelOperation floor_operation(WheelWork& work, const Progress& progress);

}  // namespace flank::internal
