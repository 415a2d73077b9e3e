/// The proof of how deep a face is cut, as a part of its verdict.
#pragma once

#include "flank/judge.h"

namespace flank::internal::verify {

/// Raises `overcut_mm` and `deepest` of the verdict to what a search finds on the whole face, borders and corners
/// included, and sets the bound. Stops where the tolerance is proved, or a deeper place is found, or at the limits.
void prove_depth(const SweptVolume& volume, double least_radius_mm, const FaceShape& face, double tolerance_mm,
                 const ProofOptions& options, FaceVerdict& verdict);

}  // namespace flank::internal::verify
