/// OBJ files as they are: in the file's own unit, nothing merged or repaired.
#pragma once

#include <string>
#include <string_view>

#include "flank/triangle_mesh.h"

namespace flank::internal {

/// Vertices and faces; polygons become fans of triangles; texture, normals, groups, lines and points are passed over.
/// Throws InputError.
[[nodiscard]] TriangleMesh read_obj(const std::string& file, std::string_view content);

}  // namespace flank::internal
