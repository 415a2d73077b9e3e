/// A smooth spline surface in place of a noisy mesh.
#pragma once

#include <optional>

#include "flank/face.h"
#include "flank/triangle_mesh.h"

namespace flank::internal {

struct MeshSplineOptions {
  int degree = 3;
  /// Control points along the longer direction: the number with the least generalised cross-validation error between
  /// these is taken.
  int fewest = 6, most = 40;
  /// How often the parameters are corrected to those of the closest points.
  int corrections = 3;
};

struct MeshSpline {
  Face face;  ///< trimmed along holes and, unless the patch has four corners, along its rim; its normal is the mesh's
  double residual_mm =
      0;  ///< root of the mean squared distance of the vertices, over the degrees of freedom: the noise
};

/// Least-squares spline surface through the vertices of a disk-like patch (mesh_parameters.h says which; holes are
/// allowed). No value for other meshes. Throws what repair_mesh throws.
[[nodiscard]] std::optional<MeshSpline> fit_spline_to_mesh(const TriangleMesh& mesh,
                                                           const MeshSplineOptions& options = {});

}  // namespace flank::internal
