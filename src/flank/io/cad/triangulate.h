/// Triangles for the trimmed faces of a part, with a stated deviation.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flank/part.h"

namespace flank::internal {

/// One face as triangles of its own: neighbours share no vertices.
struct FaceTriangles {
  std::string face;  ///< "F1"
  TriangleMesh mesh;
  /// No measured place of the surface is farther from its triangle (the middle of every side, and four inside). 0 for
  /// the faces of a mesh.
  double deviation_mm = 0.0;
  bool beyond_border = false;  ///< the trim could not be followed: the triangles cover the face and up to a cell more
};

/// Every face of a part, in its order; none for faces that were left out. A mesh gives its own triangles; a CAD face is refined until its deviation is at
/// most `deviation_mm` or it has kMostTriangles, so that the result says more than what was asked. Throws UsageError for
/// a deviation that is not > 0.
[[nodiscard]] std::vector<FaceTriangles> triangulate(const Part& part, double deviation_mm);
/// The same for one trimmed face.
[[nodiscard]] FaceTriangles triangulate_face(const Face& face, double deviation_mm);

inline constexpr int kMostTriangles = 40000;  ///< of one face, about

}  // namespace flank::internal
