/// The shank of a fit that nobody has given, and the flank below a shank that comes too near.
#pragma once

#include <string>
#include <vector>

#include "flank/pipeline/search/fit_search.h"
#include "flank/run.h"
#include "flank/setup/clearance_scene.h"

namespace flank::internal {

/// Chooses a shank for the motions found (choose_clear_shank). `flank`: the tool without it.
void choose_shank(const FitJob& job, const Setup& setup, const ClearanceScene& scene, const FitSearch& search,
                  const Tool& flank, ObstacleRequest& obstacles);

/// Lifts a shank or holder that comes too near, if the flank's length is open (lengthen.h).
void lift_shank(const FitJob& job, const ClearanceScene& scene, FitSearch& search, std::vector<std::string>& notes);

}  // namespace flank::internal
