/// The material of a closed mesh on lines.
#pragma once

#include "flank/triangle_mesh.h"
#include "flank/verify/stock/dexel_field.h"

namespace flank::internal::verify {

/// Takes from a field all that the mesh does not hold: what its surface goes round, as its triangles are turned, in either direction;
/// bodies may overlap. Where a line finds no way out, through a crack between faces that are cut into triangles one by one, it keeps what lies between
/// its first and its last triangle. Returns how many lines those are. Parallel; the same for any number of threads.
std::size_t keep_inside(DexelField& field, const TriangleMesh& mesh);

}  // namespace flank::internal::verify
