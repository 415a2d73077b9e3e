/// Polygons of mesh files as triangles.
#pragma once

#include "flank/triangle_mesh.h"

namespace flank::internal {

/// Adds a polygon of 0-based vertex indices as a fan; polygons of fewer than three corners add nothing.
void add_polygon(TriangleMesh& mesh, const int* corners, int count);

}  // namespace flank::internal
