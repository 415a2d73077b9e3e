/// Whether a half line meets nothing of the part: what a tool could be held along.
#pragma once

#include <functional>

#include "flank/clearance.h"

namespace flank::internal {

/// Answers for the half line from a place in a direction, of unit length; none if there are no obstacles but fixtures. What a line begins at may be
/// its own face: nearer than a millionth of the part nothing is met. Many threads may ask. Triangles are made of what a line comes near.
[[nodiscard]] std::function<bool(const Vec3& from, const Vec3& direction)> free_line_in(const ObstacleSet& obstacles);

}  // namespace flank::internal
