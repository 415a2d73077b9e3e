/// The blank of a cavity: what is material before the first cut.
#pragma once

#include <vector>

#include "flank/target.h"
#include "flank/trochoid/paths/side_path.h"
#include "flank/trochoid/stock/swept_stock.h"

namespace flank::internal {

/// The ends and the top of the blank as planes that hold both sides. Each is the one of those within 45 degrees of the way,
/// or of the axis, that is nearest to the middle of the cavity there: skewed or leaning edges of the sides leave no wedge of
/// material before one of them. Layers, at least one, come from the top. A real blank may be smaller: then less is cut than is planned for.
[[nodiscard]] std::vector<HalfSpace> cavity_blank(const std::vector<LayerSides>& layers, const Target& left,
                                                  const Target& right);

}  // namespace flank::internal
