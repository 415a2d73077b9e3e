/// Parameters over the unit square for a disk-like patch of a mesh.
#pragma once

#include <optional>
#include <vector>

#include "flank/geom/mesh_topology.h"

namespace flank::internal {

struct MeshParameters {
  std::vector<Vec2> uv;               ///< one a vertex, in [0, 1]^2
  double size_u = 0.0, size_v = 0.0;  ///< mean lengths of the patch in the two directions, mm
  /// The rim is the border of the square (else it lies inside, and trims have to cut it out).
  bool four_sided = false;
  /// Bit 0, 1, 2, 3: the vertex lies on u = 0, u = 1, v = 0, v = 1 of a four-sided patch.
  std::vector<char> side;
  std::vector<std::vector<int>>
      holes;  ///< vertices of the loops inside, and, if not four-sided, of the rim as the first one
};

/// A patch whose rim has four corners is spread over the square by a harmonic map (Floater and Hormann 2005) with the
/// rim's sides by arc length; another one is projected onto its mean plane, if it is a graph over it. No value: several
/// components, no rim, several rims (a tube), or no graph.
[[nodiscard]] std::optional<MeshParameters> parametrize(const TriangleMesh& mesh, const MeshTopology& topology);

}  // namespace flank::internal
