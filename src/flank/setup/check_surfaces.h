/// The other faces of a part as what the planner's tool must keep clear of.
#pragma once

#include <vector>

#include "flank/obstacle/pose_guard.h"
#include "flank/part.h"

namespace flank::internal {

/// Every face of the part but `faces` that a tool within `reach_mm` of the target could touch. Solids that the target
/// touches, other than its own, are taken whole; all else as triangles within `deviation_mm` of the face, or where that
/// takes too many, with the deviation that is left as slack.
[[nodiscard]] Obstacles other_faces(const Part& part, const std::vector<int>& faces, const Target& target,
                                    double reach_mm, double deviation_mm);

/// The target's own faces as what shank and holder keep clear of, to within a tolerance: `spare_mm` is held back besides
/// the triangles' deviation, for a judge who wants it kept for sure.
[[nodiscard]] std::vector<ObstacleMesh> own_faces(const Part& part, const std::vector<int>& faces, double deviation_mm,
                                                  double spare_mm);

}  // namespace flank::internal
