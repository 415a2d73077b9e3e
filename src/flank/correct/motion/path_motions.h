/// Motions through the poses of a path, to go on from.
#pragma once

#include <vector>

#include "flank/path.h"
#include "flank/ruled_motion.h"

namespace flank::internal {

/// One motion for each strip: rails as smooth as the fit makes them, through all poses within `near_mm` where 96 control points are
/// enough for that. At both ends they go on straight for 3 % of the way, because a strip ends where it machines no more. Throws
/// InputError for a strip of less than two poses.
[[nodiscard]] std::vector<RuledMotion> motions_through(const Path& path, double axis_length, double near_mm);

}  // namespace flank::internal
