/// Who is whose neighbour in a triangle mesh.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "flank/triangle_mesh.h"

namespace flank::internal {

/// Adjacency of an oriented manifold mesh. Side k of a triangle lies opposite its corner k and runs from corner k+1 to
/// corner k+2.
struct MeshTopology {
  std::vector<std::array<int, 3>> neighbors;  ///< [t][k]: the triangle across side k, -1 at a border
  std::vector<int>
      fan_begin;  ///< triangles around vertex v: fans[fan_begin[v]] to fans[fan_begin[v + 1] - 1], ascending
  std::vector<int> fans;
  std::vector<char> on_border;  ///< per vertex: 1 where a border side starts or ends

  /// The triangles around a vertex, ascending.
  [[nodiscard]] std::span<const int> around(int vertex) const {
    const auto v = static_cast<std::size_t>(vertex);
    return {fans.data() + fan_begin[v], fans.data() + fan_begin[v + 1]};
  }
};

/// One side of one triangle.
struct TriangleSide {
  int triangle = -1, side = 0;
};

/// Sides whose triangles' normals differ by more are edges of the part: each side of them ends there like at a border.
inline constexpr double kCreaseRad = 0.9;

/// Sides that belong to exactly two triangles, in opposite directions, and whose triangles' normals differ by less than
/// `crease_rad`, are linked; all others are borders. Vertices where several fans of linked triangles meet are doubled
/// in `mesh`, one vertex a fan, appended at the end, so that creases, fins and bow ties come apart.
[[nodiscard]] MeshTopology link_triangles(TriangleMesh& mesh, double crease_rad);

/// One side of one triangle, under the name of its edge: all triangles of an edge have the same low and high.
struct EdgeUse {
  int low = 0, high = 0;  ///< vertices
  int triangle = 0;
  signed char side = 0;    ///< lies opposite this corner
  bool ascending = false;  ///< whether the triangle runs from low to high
};

/// The sides of all triangles, sorted by low, high and triangle: counted, not hashed, so that the order does not depend on a library.
[[nodiscard]] std::vector<EdgeUse> mesh_edges(const TriangleMesh& mesh);

/// The neighbours alone, of a mesh whose edges (mesh_edges) are known: those that link_triangles finds in a copy of it.
[[nodiscard]] std::vector<std::array<int, 3>> linked_neighbors(const TriangleMesh& mesh,
                                                               const std::vector<EdgeUse>& edges, double crease_rad);

/// Visits the sides of each edge: one is a border, more than two is not manifold.
template <class Visit>
void for_each_edge(const std::vector<EdgeUse>& uses, Visit&& visit) {
  for (std::size_t i = 0; i < uses.size();) {
    std::size_t j = i + 1;
    while (j < uses.size() && uses[j].low == uses[i].low && uses[j].high == uses[i].high) ++j;
    visit(std::span<const EdgeUse>(uses.data() + i, j - i));
    i = j;
  }
}

/// Number of the connected component of each triangle, counted from 0 in the order of the triangles.
[[nodiscard]] std::vector<int> components(const MeshTopology& topology);

/// Closed border loops, each in the triangles' own direction (the surface lies to the left, seen from the machining
/// side).
[[nodiscard]] std::vector<std::vector<TriangleSide>> border_loops(const TriangleMesh& mesh,
                                                                  const MeshTopology& topology);

/// Corner k of the angle in triangle t, in radians.
[[nodiscard]] double corner_angle(const TriangleMesh& mesh, int triangle, int corner);

/// Sum over the loop's vertices of pi minus the surface's inner angle: near 2 pi for the rim of a disk, 0 for the end
/// of a tube, -2 pi for a hole cut into a surface (exact on a plane; the surface's own curvature shifts it).
[[nodiscard]] double total_turning(const TriangleMesh& mesh, const MeshTopology& topology,
                                   std::span<const TriangleSide> loop);

/// Triangles around each vertex alone, neighbours being left out.
[[nodiscard]] MeshTopology fans_of(const TriangleMesh& mesh);

/// Unit normals of the triangles (zero where the area is zero) and, weighted by the corner angles, of the vertices; one
/// of the triangles' where those around a vertex cancel.
[[nodiscard]] std::vector<Vec3> triangle_normals(const TriangleMesh& mesh);
[[nodiscard]] std::vector<Vec3> vertex_normals(const TriangleMesh& mesh);
/// One of the former, for those who need few; `around`: the triangles around the vertex, ascending.
[[nodiscard]] Vec3 vertex_normal(const TriangleMesh& mesh, int vertex, std::span<const int> around);

}  // namespace flank::internal
