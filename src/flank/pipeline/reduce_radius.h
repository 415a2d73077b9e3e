/// What the judge sees and the search did not, taken off a free tool's radius.
#pragma once

#include "flank/judge.h"
#include "flank/pipeline/search/fit_search.h"

namespace flank::internal {

/// Makes a free tool thinner where the judge finds it a little deeper than the tolerance (FitBudget::thinned): every length
/// less on the radius is one less of depth, everywhere. False if nothing is to be done, or nothing can be.
[[nodiscard]] bool reduce_radius(double tolerance_mm, FitSearch& search, const VerifyReport& verify);

}  // namespace flank::internal
