/// Roughing of the channels.
#pragma once

#include "flank/wheel/wheel_work.h"

namespace flank::internal {

/// Layers over the hub, from the tips' outline down, in all channels of one sector, with a larger tool where one fits between the blades.
/// It keeps off the part by an allowance, and by how far the blades differ; the other sectors are turned copies. A layer is as deep
/// as the tip's radius, and its first pass cuts a slot: the judge tells the engagement (pipeline/folder/judge_roughing.h).
[[nodiscard]] WheelOperation rough_operation(WheelWork& work);

}  // namespace flank::internal
