/// Indexed triangle mesh, as values.
#pragma once

#include <array>
#include <vector>

#include "flank/vec.h"

namespace flank {

struct TriangleMesh {
  std::vector<Vec3> vertices;
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise seen from the machining side

  [[nodiscard]] Box3 box() const {
    Box3 b;
    for (const Vec3& v : vertices) b.add(v);
    return b;
  }
};

}  // namespace flank
