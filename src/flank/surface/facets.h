/// A mesh as it is, flat triangles, with what a target has.
#pragma once

#include <memory>

#include "flank/target.h"
#include "flank/triangle_mesh.h"

namespace flank::internal {

/// For what a tool keeps out of: its triangles are what the judge looks at, while a surface through noisy corners may lie several
/// times the noise off them, and one of a few triangles anywhere. Closest points are exact; there the normal is that of the triangle,
/// on an edge or a corner the mean of its triangles' (by their angles), and curvatures are zero. Nothing is extended: `track` is a
/// cold query. Throws InputError for a mesh without triangles.
[[nodiscard]] std::unique_ptr<Target> make_facets(TriangleMesh mesh);

}  // namespace flank::internal
