/// Meshes that bound a solid: which side of them is out is known.
#pragma once

#include "flank/setup/setup.h"

namespace flank::internal {

/// Is the part a mesh, and are the components that the targets belong to closed? Reading has turned those so that their
/// normals point away from the material.
[[nodiscard]] bool targets_bound_a_solid(const Setup& setup);

}  // namespace flank::internal
