/// Indexed triangle mesh, as values.
#pragma once

#include <array>
#include <vector>

#include "flank/vec.h"

namespace flank {

/// It may be open and have several components. Lengths in mm.
struct TriangleMesh {
  std::vector<Vec3> vertices;
  /// Three indices into `vertices` each.
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise seen from the machining side

  [[nodiscard]] Box3 box() const {
    Box3 b;
    for (const Vec3& v : vertices) b.add(v);
    return b;
  }
};

}  // namespace flank
