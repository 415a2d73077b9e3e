/// How far roughing lets the blades of a wheel stand free on one side, while the channel on their other side is not cut yet.
#pragma once

#include <vector>

#include "flank/path.h"
#include "flank/pipeline/folder/wheel_plan.h"
#include "flank/setup/setup.h"

namespace flank::internal {

/// mm over the hub, at most. `operations`: those that rough, of one sector, each run in all sectors before the next one, with a tool of this
/// tip radius. While one runs, a channel may be as deep as its lowest place, and the next one only as deep as the one before it has left
/// it; before the first one the blades stand in the blank to their tips. 0 where hub or sides are not known.
[[nodiscard]] double free_height(const WheelPlan& plan, const Setup& setup, const std::vector<Path>& operations,
                                 double tip_radius);

}  // namespace flank::internal
