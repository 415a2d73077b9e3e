/// Cuts a mesh into faces, as a CAD file has them.
#pragma once

#include <numbers>
#include <vector>

#include "flank/triangle_mesh.h"

namespace flank::internal {

/// Where one face of a mesh ends and the next begins.
struct RegionOptions {
  /// A turn of the normal that makes an edge, in radians.
  double sharp_rad = 40.0 * std::numbers::pi / 180.0;
  /// The turn counts when it happens within this share of the box's diagonal: a rounded leading edge of a blade is an
  /// edge of the blade.
  double edge_width_share = 0.015;
  /// Regions with a smaller share of the area join the neighbour with which they share the longest border.
  double least_area_share = 1e-4;
};

/// Triangles of each region, by descending area (so that the two long sides of a blade come first); triangles
/// ascending. Every triangle is in one region. Borders are sharp edges, non-manifold edges, and the rounded edges
/// between smooth sides, which become regions of their own.
[[nodiscard]] std::vector<std::vector<int>> mesh_regions(const TriangleMesh& mesh, const RegionOptions& options = {});

}  // namespace flank::internal
