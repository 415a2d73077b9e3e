/// What a mesh file gets before anybody uses it: sound topology, outward orientation, and an account of every change.
#pragma once

#include <string>
#include <vector>

#include "flank/triangle_mesh.h"

namespace flank::internal {

/// Vertices nearer to each other than this share of the box's diagonal are one vertex (single precision, and text with
/// six digits).
inline constexpr double kWeldShare = 1e-7;
/// A component that hangs on others by non-manifold edges only and has less than this share of the area is a fin, and
/// is removed.
inline constexpr double kFinAreaShare = 0.01;

struct ReadMesh {
  TriangleMesh mesh;
  std::vector<std::string>
      repairs;  ///< what was repaired, and what is left as it is (holes, non-manifold edges), one sentence each
};

/// Welds, removes degenerate and duplicate triangles and fins, makes the orientation of each component consistent, and
/// turns components that enclose a volume outwards. `soup`: vertices are repeated by the format itself, so welding is
/// no repair. Throws InputError (without a file name) for what cannot be mended.
[[nodiscard]] ReadMesh repair_read_mesh(TriangleMesh mesh, bool soup);

}  // namespace flank::internal
