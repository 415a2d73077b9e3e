/// A target moved towards the machining side by a constant: the surface that is wanted where material is left on purpose.
#pragma once

#include <memory>

#include "flank/target.h"

namespace flank::internal {

/// The surface `offset_mm` > 0 from `target`. Its footpoints are those of `target`, moved along the normal: distances less by the
/// offset, a radius of curvature towards the tool smaller by it, one away from the tool larger. About a sharp edge between two faces, and
/// about its border, it is round: nothing of `target` is nearer than the offset to any of it.
/// Where `target` bends towards the tool with a radius of the offset or less there is no such surface (sharpest_bend).
[[nodiscard]] std::unique_ptr<Target> offset_target(std::unique_ptr<Target> target, double offset_mm);

/// The largest curvature towards the machining side over about 2,000 samples, 1/mm; 0 or less: it bends away everywhere.
[[nodiscard]] double sharpest_bend(const Target& target);

}  // namespace flank::internal
