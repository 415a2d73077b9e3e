/// OBJ files as they are: in the file's own unit, nothing merged or repaired.
#pragma once

#include <string>
#include <string_view>

#include "flank/triangle_mesh.h"

namespace flank::internal {

/// An OBJ file has no magic number: among its first lines with content there is a vertex, and every keyword is one of
/// the format's.
[[nodiscard]] bool looks_obj(std::string_view content);

/// Vertices and faces; polygons become fans of triangles; texture, normals, groups, lines and points are passed over.
/// Throws InputError.
[[nodiscard]] TriangleMesh read_obj(const std::string& file, std::string_view content);

}  // namespace flank::internal
