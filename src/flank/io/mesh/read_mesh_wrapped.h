/// Sides and edges of a region of a mesh that wraps round thick edges, as a skin of a CAD file does.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "flank/io/mesh/read_mesh_edges.h"
#include "flank/triangle_mesh.h"

namespace flank::internal {

/// What is known of the triangles of a mesh.
struct FacetView {
  const TriangleMesh& mesh;
  std::span<const Facet> facets;
  std::span<const double> areas;
  std::span<const std::array<int, 3>> smooth;  ///< neighbours across edges that are not sharp; -1: none
};

/// For each triangle of a region the number of its side, from 0 on, or -1 on an edge; empty if the region does not wrap
/// round anything. An edge bends as that of a face does (geom/pieces/face_section.h): by more than kEdgeBend over the region's
/// reach behind it, against the normal. A region has two sides or more, each of at least a fifth of it.
[[nodiscard]] std::vector<int> wrapped_sides(const FacetView& mesh, const std::vector<int>& region);

}  // namespace flank::internal
