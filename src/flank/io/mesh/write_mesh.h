/// Writing triangle meshes. Coordinates are written as they are: a mesh file has no unit.
#pragma once

#include <string>

#include "flank/triangle_mesh.h"

namespace flank::internal {

/// ".stl, .obj or ...": how files end that write_mesh writes.
[[nodiscard]] std::string written_mesh_endings();
[[nodiscard]] bool is_written_mesh(const std::string& file);

/// In the format that the extension of `file` says; binary and in double precision where the format can (STL has
/// single precision). Throws UsageError for another extension, InputError if the file cannot be written; nothing half-written
/// is left.
void write_mesh(const std::string& file, const TriangleMesh& mesh);

/// The bytes of a binary STL.
[[nodiscard]] std::string mesh_to_stl(const TriangleMesh& mesh);

}  // namespace flank::internal
