/// How noisy a mesh is, and which jets suit it.
#pragma once

#include "flank/geom/mesh_topology.h"
#include "flank/surface/mesh/jet_field.h"

namespace flank::internal {

/// Below this noise, relative to the box's diagonal, a mesh counts as exact: the rounding of single-precision files is
/// 1e-8 to 1e-7.
inline constexpr double kExactNoise = 5e-7;

struct MeshQuality {
  double noise_mm = 0.0;        ///< standard deviation of the heights about smooth jets
  double noise_relative = 0.0;  ///< over the diagonal of the mesh's box
  bool noisy = false;  ///< noise_relative > kExactNoise, and twice as wide jets leave no more than 1.5 times as much:
                       ///< noise, not shape
  JetOptions jets;     ///< what to fit: close to exact data; as wide as the noise hides the jets' own error otherwise
};

/// From the residuals of jets over growing neighbourhoods, at up to 1,000 vertices spread evenly over their numbers.
[[nodiscard]] MeshQuality estimate_noise(const TriangleMesh& mesh, const MeshTopology& topology,
                                         const std::vector<Vec3>& normals);

/// The same for a mesh on its own, repaired first. Throws what repair_mesh throws.
[[nodiscard]] MeshQuality estimate_noise(const TriangleMesh& mesh);

}  // namespace flank::internal
