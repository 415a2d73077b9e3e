/// The other faces of a part as what the planner's tool must keep clear of.
#pragma once

#include <vector>

#include "flank/clearance/pose_clearance.h"
#include "flank/io/part.h"

namespace flank {

/// Every face of the part but `faces` that a tool within `reach_mm` of the box could touch, as triangles within
/// `deviation_mm` of it (where the triangulation can).
[[nodiscard]] std::vector<CheckSurface> other_faces(const Part& part, const std::vector<int>& faces, const Box3& box,
                                                    double reach_mm, double deviation_mm);

}  // namespace flank
