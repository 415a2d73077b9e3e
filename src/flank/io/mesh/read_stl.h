/// STL files as they are: in the file's own unit, nothing merged or repaired.
#pragma once

#include <string>
#include <string_view>

#include "flank/triangle_mesh.h"

namespace flank::internal {

/// Whether the content has the size that a binary STL states for itself (80 bytes, a count, 50 bytes a facet).
[[nodiscard]] bool is_binary_stl(std::string_view content);

/// Whether it is a binary STL, or a text that begins as one: the word "solid" alone is not enough, binary files may begin
/// with it, too.
[[nodiscard]] bool looks_stl(std::string_view content);

/// Binary or text. Every facet has three vertices of its own. Throws InputError naming the line or the facet.
[[nodiscard]] TriangleMesh read_stl(const std::string& file, std::string_view content);

}  // namespace flank::internal
