/// Mesh files as they are: in the file's own unit, nothing merged or repaired.
#pragma once

#include <string>
#include <string_view>

#include "flank/triangle_mesh.h"

namespace flank::internal {

/// Binary or text. Every facet has three vertices of its own. Throws InputError naming the line or the facet.
[[nodiscard]] TriangleMesh read_stl(const std::string& file, std::string_view content);

/// Vertices and faces; polygons become fans of triangles; texture, normals, groups, lines and points are passed over.
/// Throws InputError.
[[nodiscard]] TriangleMesh read_obj(const std::string& file, std::string_view content);

/// ASCII or binary of either byte order; polygons become fans of triangles; other elements and properties are passed
/// over. Throws InputError.
[[nodiscard]] TriangleMesh read_ply(const std::string& file, std::string_view content);

/// Adds a polygon of 0-based vertex indices as a fan; polygons of fewer than three corners add nothing.
void add_polygon(TriangleMesh& mesh, const int* corners, int count);

}  // namespace flank::internal
