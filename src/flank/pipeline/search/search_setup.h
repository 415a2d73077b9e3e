/// What every search of a tool begins with: bounds of its radius, and what its flank keeps clear of.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flank/fit.h"
#include "flank/setup/setup.h"
#include "flank/setup/targets.h"

namespace flank::internal {

/// Open bounds: a hundredth of the target's diagonal to 15 hundredths of it.
[[nodiscard]] RadiusBounds radius_bounds(const RadiusRequest& radius, const ObstacleRequest& obstacles,
                                         double diagonal);

/// Gives every target what the flank, and a shank that is in the way, keep clear of: the check faces, the other targets and fixtures, as far as
/// they reach.
void add_group_obstacles(const Setup& setup, const ObstacleRequest& request, const RadiusBounds& bounds,
                         std::vector<TargetGroup>& targets);

}  // namespace flank::internal
