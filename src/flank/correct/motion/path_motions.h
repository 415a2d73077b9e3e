/// Motions through the poses of a path, to go on from.
#pragma once

#include <vector>

#include "flank/path.h"
#include "flank/ruled_motion.h"

namespace flank::internal {

/// One motion for each strip: rails as smooth as the fit makes them, through all poses within `near_mm` where 96 control points are
/// enough for that. They begin and end where the strips do: beyond its end a strip leaves what its last pose is, and a motion that ran on
/// would cut there. Throws InputError for a strip of less than two poses.
[[nodiscard]] std::vector<RuledMotion> motions_through(const Path& path, double axis_length, double near_mm);

}  // namespace flank::internal
