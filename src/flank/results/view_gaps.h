/// How far things that may not be touched stay from the tool's bodies: for colours. The figures that count are the judge's of
/// clearances (flank/clearance.h).
#pragma once

#include <vector>

#include "flank/path.h"
#include "flank/results/view_mesh.h"
#include "flank/tool.h"

namespace flank::internal {

/// The flank may touch the part, and is judged there by itself.
enum class ToolBodies { kAll, kAboveTheFlank };

/// Fills ViewFace::gap_mm: for each vertex the least signed distance to the bodies at these poses, or at every so
/// many of them where that is too much work. Measured across or along the axis, whichever is more: exact beside a cylinder,
/// too large beside a cone.
void measure_gaps(const Tool& tool, const std::vector<Pose>& all_poses, ToolBodies bodies,
                  const std::vector<ViewFace*>& faces);

}  // namespace flank::internal
