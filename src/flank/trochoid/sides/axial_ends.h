/// Ends of a side's motion that lead along the tool's own axis.
#pragma once

#include "flank/ruled_motion.h"

namespace flank::internal {

/// The motion without ends on which the middle of the axis goes up or down along the axis, less than 45 degrees off it. Before a wall
/// across the way a fit has nowhere to go on and slides the tool along its axis, which a flank hardly feels; cycles get stuck there,
/// because nothing goes forward that cuts. What remains is the same to the last digit. What is axial for more than a quarter
/// of the way is the walls' own, and stays.
[[nodiscard]] RuledMotion without_axial_ends(const RuledMotion& motion);

}  // namespace flank::internal
