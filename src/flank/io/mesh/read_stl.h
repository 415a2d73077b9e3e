/// STL files as they are: in the file's own unit, nothing merged or repaired.
#pragma once

#include <string>
#include <string_view>

#include "flank/triangle_mesh.h"

namespace flank::internal {

/// Binary or text. Every facet has three vertices of its own. Throws InputError naming the line or the facet.
[[nodiscard]] TriangleMesh read_stl(const std::string& file, std::string_view content);

}  // namespace flank::internal
