/// A stretch of a motion, as a motion of its own.
#pragma once

#include "flank/ruled_motion.h"

namespace flank::internal {

/// The motion between two of its times, 0 <= first < last <= 1, over [0, 1] again: the same poses to the last digits, by knots put in.
[[nodiscard]] RuledMotion motion_part(const RuledMotion& motion, double first, double last);

}  // namespace flank::internal
