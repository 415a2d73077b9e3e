/// Poses that are known in closed form, leg after leg, as one motion.
#pragma once

#include <functional>
#include <vector>

#include "flank/path.h"
#include "flank/ruled_motion.h"

namespace flank::internal {

/// The pose at a share in [0, 1] of a leg; smooth.
using Leg = std::function<Pose(double share)>;

/// How far a leg goes, mm: of the end of the axis that goes farther, and of a point as far from the axis as the axis is long where it turns.
[[nodiscard]] double way_of(const Leg& leg, double axis_length_mm);

/// One motion through legs each of which begins where the one before ends. Times go with the way. Both ends of the axis are within
/// `off_mm` of the legs at the places between their nodes that are looked at. A leg of no way is left out; where legs meet the motion
/// may turn. Throws InternalError without a leg that has a way.
[[nodiscard]] RuledMotion motion_through(const std::vector<Leg>& legs, double axis_length_mm, double off_mm);

}  // namespace flank::internal
