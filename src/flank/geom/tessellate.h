/// A face as triangles for showing it, and for questions about what lies in a line: not for measuring, and not watertight against its
/// neighbours.
#pragma once

#include <vector>

#include "flank/face.h"
#include "flank/triangle_mesh.h"

namespace flank::internal {

struct TessellationOptions {
  double chord_mm = 0.05;  ///< the triangles aim to stay this near to the surface
  double edge_mm = 1e300;  ///< longest side of a cell of the grid
  int most_steps = 400;    ///< cells per direction, at most
};

struct Tessellation {
  TriangleMesh mesh;                       ///< counter-clockwise seen against the outward normal
  std::vector<Vec2> parameters;            ///< of each vertex
  std::vector<std::vector<Vec3>> borders;  ///< the loops of the face as polylines
};

/// Triangles of a trimmed face: a grid over its parameter rectangle; cells that a loop cuts are divided again and cut
/// along it, so that the border is off by less than a quarter of a cell's side. Throws UsageError for lengths that are
/// not above 0.
[[nodiscard]] Tessellation tessellate(const Face& face, const TessellationOptions& options);

/// Adds the triangles of another mesh, a face beside others, with vertices of their own.
void append(TriangleMesh& all, const TriangleMesh& mesh);

}  // namespace flank::internal
