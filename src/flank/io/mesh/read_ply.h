/// PLY files as they are: in the file's own unit, nothing merged or repaired.
#pragma once

#include <string>
#include <string_view>

#include "flank/triangle_mesh.h"

namespace flank::internal {

/// Whether the first line is that of the format.
[[nodiscard]] bool looks_ply(std::string_view content);

/// ASCII or binary of either byte order; polygons become fans of triangles; other elements and properties are passed
/// over. Throws InputError.
[[nodiscard]] TriangleMesh read_ply(const std::string& file, std::string_view content);

}  // namespace flank::internal
