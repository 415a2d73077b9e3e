/// Polygons of mesh files as triangles.
#pragma once

#include "flank/triangle_mesh.h"

namespace flank::internal {

/// Adds a polygon of 0-based vertex indices, in the plane that fits it: a convex one as a fan, another one by clipping its
/// ears. Polygons of fewer than three corners add nothing. Throws InputError, without the file's name, for one of more
/// than 2,000 corners that is not convex.
void add_polygon(TriangleMesh& mesh, const int* corners, int count);

}  // namespace flank::internal
