/// How far the triangles of a mesh lie off the smooth surface through their corners: no farther than their folds tell of it, whatever
/// the blended surface does beside slivers.
#pragma once

#include "flank/target.h"

namespace flank::internal {

struct FacetGaps {
  double share = 0.0;       ///< of the area, where that is farther than was asked
  double largest_mm = 0.0;  ///< at the places that were looked at
};

/// Of the mesh that a target was made of; nothing for other targets.
[[nodiscard]] FacetGaps facet_gaps(const Target& target, double beyond_mm);

/// The most that smooth motions can finish of a target, as a share of its area: a mesh's triangles that lie more than two tolerances
/// off the smooth surface are cut too deep on one side of it, or left on the other. 1 for other targets.
[[nodiscard]] double coverage_bound_by_facets(const Target& target, double tolerance_mm);

}  // namespace flank::internal
