/// What a part may be, whoever read it.
#pragma once

#include "flank/part.h"

namespace flank::internal {

/// Throws InputError naming file and face if a number is not finite, or the part is larger or smaller than any part is
/// (kLargestCoordinateMm, kSmallestBoxMm).
void require_part_in_range(const Part& part);

}  // namespace flank::internal
