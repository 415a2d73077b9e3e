/// A gouge that the judge found and the search did not, taken out by another pass.
#pragma once

#include "flank/judge.h"
#include "flank/pipeline/search/fit_search.h"

namespace flank::internal {

/// Mends motions and tool where the judge finds a target cut deeper than the tolerance: the judge's worst places are added to the
/// samples, which get denser, too. False if nothing is to be done (no place of a target is too deep, or one so deep that another motion is
/// needed), or nothing better was found.
[[nodiscard]] bool refit_at_cuts(double tolerance_mm, FitSearch& search, const VerifyReport& verify);

}  // namespace flank::internal
