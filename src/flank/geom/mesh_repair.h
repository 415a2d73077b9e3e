/// Makes a mesh as it comes from a file fit for geometry, and keeps account of what was changed.
#pragma once

#include <string>

#include "flank/triangle_mesh.h"

namespace flank::internal {

/// What repair_mesh did. All zero: the mesh was sound.
struct MeshRepair {
  int welded_vertices = 0;       ///< vertices at the place of another one
  int isolated_vertices = 0;     ///< vertices of no triangle
  int degenerate_triangles = 0;  ///< with a corner used twice, or of zero area and not mended by a swap of diagonals
  int duplicate_triangles = 0;   ///< the same three corners again
  int swapped_diagonals = 0;     ///< zero-area triangles mended by swapping their longest side
  int flipped_triangles = 0;     ///< turned round to agree with the larger part of their component

  [[nodiscard]] bool clean() const;
  /// "welded 3 vertices, flipped 12 triangles"; "nothing" if clean.
  [[nodiscard]] std::string account() const;
};

struct RepairedMesh {
  TriangleMesh mesh;
  MeshRepair repair;
};

/// Welds vertices closer than `weld_share` times the diagonal of the box of what the triangles use, but for a few vertices far away
/// (0: equal coordinates only), removes degenerate and
/// duplicate triangles and isolated vertices, and turns triangles so that neighbours agree. A sound mesh comes back
/// with its numbering unchanged. Throws InputError: no triangles, an index out of range, a coordinate that is not
/// finite, no area at all, or a one-sided (Moebius) component.
[[nodiscard]] RepairedMesh repair_mesh(TriangleMesh mesh, double weld_share = 0.0);

}  // namespace flank::internal
