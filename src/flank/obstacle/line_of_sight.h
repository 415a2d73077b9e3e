/// Whether a line meets triangles.
#pragma once

#include <array>

#include "flank/obstacle/triangle_tree.h"
#include "flank/triangle_mesh.h"

namespace flank::internal {

/// The corners of a triangle of a mesh.
[[nodiscard]] std::array<Vec3, 3> corners_of(const TriangleMesh& mesh, std::size_t triangle);

/// The triangles of a mesh as a tree.
[[nodiscard]] TriangleTree tree_of(const TriangleMesh& mesh);

/// Does the half line from a place meet any triangle farther away than `least_mm`? The direction need not have unit length; `least_mm` is
/// in its length then.
[[nodiscard]] bool meets(const TriangleTree& tree, const Vec3& from, const Vec3& direction, double least_mm);

}  // namespace flank::internal
