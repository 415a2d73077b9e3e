/// Faces that are one smooth skin.
#pragma once

#include <vector>

#include "flank/part.h"

namespace flank::internal {

/// `faces` (indices) and all that is joined smoothly to them (Joints), over any number of faces, without fillets and edges: faces
/// half of which bends by more than kEdgeBend (geom/pieces/face_section.h) over the mean width of the skin; ascending. A region of
/// a mesh ends where it is not smooth any more, so that it is its own skin.
[[nodiscard]] std::vector<int> smooth_skin(const Part& part, const std::vector<int>& faces);

}  // namespace flank::internal
