/// The tolerance of a request that gives none: it follows the size of what is machined.
#pragma once

namespace flank::internal {

/// A thousandth of the diagonal of all that is machined, rounded down to 1, 2 or 5 times a power of ten; from 0.005 to 0.5 mm.
[[nodiscard]] double default_tolerance(double diagonal_mm);

}  // namespace flank::internal
