/// The free-form cavity: two facing walls given by a formula, of any size.
#pragma once

#include <vector>

#include "flank/example.h"
#include "flank/face.h"

namespace flank::internal {

/// Both walls, F1 at +y and F2 at -y, open sheets that look at each other; half a turn about z carries each into the other.
/// Every section across the channel is the same hollow profile, leaning outwards towards the top, turned by the twist and
/// shifted along an S: smooth, not ruled, and no envelope of a tool. Walls at its ends look inwards, F3 and F4, that of the end first. Throws UsageError
/// for sizes that are not > 0, a twist beyond 60 or a lean beyond 45 degrees, and walls that would meet.
[[nodiscard]] std::vector<Face> cavity_walls(const CavityShape& shape);

}  // namespace flank::internal
