/// Which vertices of a mesh are at the same place.
#pragma once

#include <vector>

#include "flank/vec.h"

namespace flank::internal {

/// For each vertex the first one of `vertices` within `tolerance` that stays; itself if there is none, and then it is one of
/// those that stay. 0: equal coordinates only. Needs finite coordinates within 10^9 tolerances of each other.
[[nodiscard]] std::vector<int> representatives(const std::vector<Vec3>& vertices, double tolerance);

}  // namespace flank::internal
