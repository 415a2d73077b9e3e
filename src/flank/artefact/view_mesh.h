/// The faces of a part as triangles to look at.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "flank/artefact/view.h"

namespace flank::internal {

/// Every face of the part: `targets` (indices) finely, those named in `entered` nearly so, the others as coarsely as they
/// may look.
[[nodiscard]] std::vector<ViewFace> view_faces(const Part& part, const std::vector<int>& targets,
                                               const std::set<std::string>& entered);

}  // namespace flank::internal
