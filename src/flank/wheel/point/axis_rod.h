/// A rod in the tool's axis, from its flank to beyond the wheel, as thick as its shank: whatever holds the tool is there. It ends in a ball, so it
/// begins a radius above the flank: lower down it would meet what the flank touches.
#pragma once

#include "flank/tool.h"

namespace flank::internal {

/// Radius of a tool's shank, mm: of its own, or, where it has none, as thick as the flank ends: no chosen shank is thicker.
[[nodiscard]] double shank_radius(const Tool& tool);

/// Passes of the tip are planned with room beside the shank. What the triangles of the wheel may be off their faces decides nothing against a path
/// that was planned on the faces themselves.
enum class RodRoom { kPlanned, kGuarded };
[[nodiscard]] double rod_radius(double shank_mm, double reach_mm, RodRoom room);

}  // namespace flank::internal
