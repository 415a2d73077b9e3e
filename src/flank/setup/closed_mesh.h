/// Meshes that bound a solid: which side of them is out is known.
#pragma once

#include <vector>

#include "flank/part.h"

namespace flank::internal {

/// Is the part a mesh, and are the components that these faces belong to closed? Reading has turned those so that their
/// normals point away from the material.
[[nodiscard]] bool bound_a_solid(const Part& part, const std::vector<int>& faces);

}  // namespace flank::internal
