/// The blank of a cavity: what is material before the first cut.
#pragma once

#include <vector>

#include "flank/target.h"
#include "flank/trochoid/cycles.h"

namespace flank::internal {

/// The ends and the top of the blank as planes that hold both sides: at each end the plane along the axis that joins the
/// ends of the side paths across the cavity, moved outwards until no point of the sides is beyond it; at the top the plane
/// across the axis, likewise. A real blank may be smaller: then less is cut than is planned for.
[[nodiscard]] std::vector<HalfSpace> cavity_blank(const LayerSides& top, const Target& left, const Target& right);

}  // namespace flank::internal
