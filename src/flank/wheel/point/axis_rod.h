/// A rod in the tool's axis, from its flank to beyond the wheel: whatever holds the tool is there.
#pragma once

#include "flank/radial_function.h"

namespace flank::internal {

/// The judge asks for a tenth of the upper end's radius, beside triangles that are off their faces by up to four thousandths of the part's size
/// (setup/clearance_scene). Paths are planned and held against the wheel with more, the former with most.
enum class RodRoom { kPlanned, kGuarded };
[[nodiscard]] double rod_radius(const RadialFunction& radial, double reach_mm, RodRoom room);

}  // namespace flank::internal
