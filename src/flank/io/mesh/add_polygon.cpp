#include "flank/io/mesh/add_polygon.h"

namespace flank::internal {

void add_polygon(TriangleMesh& mesh, const int* corners, int count) {
  for (int k = 2; k < count; ++k) mesh.triangles.push_back({corners[0], corners[k - 1], corners[k]});
}

}  // namespace flank::internal
