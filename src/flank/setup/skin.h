/// Faces that are one smooth skin.
#pragma once

#include <vector>

#include "flank/part.h"

namespace flank::internal {

/// Faces are joined smoothly where their normals differ by no more than this along a border that they share.
inline constexpr double kSkinAngleDeg = 5.0;

/// `faces` (indices) and all that is joined smoothly to them, over any number of faces, without fillets and edges: faces
/// half of which bends by more than kEdgeBend (geom/face_pieces.h) over the mean width of the skin; ascending. A region of
/// a mesh ends where it is not smooth any more, so that it is its own skin.
[[nodiscard]] std::vector<int> smooth_skin(const Part& part, const std::vector<int>& faces);

}  // namespace flank::internal
