/// Curvatures of a piece of a mesh, coarse and robust: what a table of faces needs.
#pragma once

#include <utility>
#include <vector>

#include "flank/triangle_mesh.h"

namespace flank::internal {

/// A patch of this many vertices is fitted by a quadric at each sample: enough to average noise, small against a face.
inline constexpr int kPatchVertices = 90;
/// A patch of fewer vertices is not fitted.
inline constexpr int kLeastPatchVertices = 12;

/// Principal curvatures (lower, upper; 1/mm, positive where the surface bends towards the side of the triangles'
/// normals) at about `count` vertices, spread evenly over their order. A least-squares quadric in the frame of the
/// patch's mean normal; errors are of the order of the noise over the patch's radius squared. Empty for small meshes.
[[nodiscard]] std::vector<std::pair<double, double>> mesh_curvatures(const TriangleMesh& mesh, int count);

}  // namespace flank::internal
