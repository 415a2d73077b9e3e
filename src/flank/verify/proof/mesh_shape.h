/// A mesh as cells: clusters of triangles, triangles and their similar parts, edges and vertices.
#pragma once

#include <memory>

#include "flank/triangle_mesh.h"
#include "flank/verify/proof/shape.h"

namespace flank::internal::verify {

/// The mesh must outlive the shape.
[[nodiscard]] std::unique_ptr<Shape> make_shape(const TriangleMesh& mesh);

}  // namespace flank::internal::verify
