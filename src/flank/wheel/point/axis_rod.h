/// A rod in the tool's axis, from its flank to beyond the wheel, as thick as its shank: whatever holds the tool is there. It ends in a ball, so it
/// begins a radius above the flank: lower down it would meet what the flank touches.
#pragma once

#include "flank/tool.h"

namespace flank::internal {

/// Radius of a tool's shank, mm: of its own, or, where it has none, as thick as the flank ends: no chosen shank is thicker.
[[nodiscard]] double shank_radius(const Tool& tool);

/// Paths are planned and held against the wheel with a rod that is thicker than the shank, the former with most: triangles are off their faces.
enum class RodRoom { kPlanned, kGuarded };
[[nodiscard]] double rod_radius(double shank_mm, double reach_mm, RodRoom room);

}  // namespace flank::internal
