/// Writing triangle meshes. Coordinates are written as they are: a mesh file has no unit.
#pragma once

#include <string>

#include "flank/triangle_mesh.h"

namespace flank::internal {

/// Binary STL (single precision), OBJ or binary little-endian PLY (both in double precision), by the extension of
/// `file`. Throws UsageError for another extension, InputError if the file cannot be written; nothing half-written is
/// left.
void write_mesh(const std::string& file, const TriangleMesh& mesh);

/// The bytes of a binary STL.
[[nodiscard]] std::string mesh_to_stl(const TriangleMesh& mesh);

}  // namespace flank::internal
