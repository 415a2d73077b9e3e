/// How far the triangles of a mesh lie off the smooth surface through their corners.
#pragma once

#include "flank/target.h"

namespace flank::internal {

struct FacetGaps {
  double share = 0.0;       ///< of the area, where that is farther than was asked
  double largest_mm = 0.0;  ///< at the places that were looked at
};

/// Of the mesh that a target was made of; nothing for other targets.
[[nodiscard]] FacetGaps facet_gaps(const Target& target, double beyond_mm);

}  // namespace flank::internal
