/// Whether a line meets triangles.
#pragma once

#include "flank/obstacle/triangle_tree.h"
#include "flank/triangle_mesh.h"

namespace flank::internal {

/// The triangles of meshes as a tree.
[[nodiscard]] TriangleTree tree_of(const TriangleMesh& mesh);

/// Does the half line from a place meet any triangle farther away than `least_mm`? The direction need not have unit length; `least_mm` is
/// in its length then.
[[nodiscard]] bool meets(const TriangleTree& tree, const Vec3& from, const Vec3& direction, double least_mm);

}  // namespace flank::internal
