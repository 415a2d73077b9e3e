/// What the judge finds too deep is taken back, by another motion or by a thinner tool.
#pragma once

#include <optional>

#include "flank/judge.h"
#include "flank/pipeline/search/fit_search.h"

namespace flank::internal {

/// A fit, and what the judge said of it.
struct JudgedFit {
  FlankFitResult fit;
  VerifyReport verify;
};

/// Changes the fit of the search where the judge finds it deeper than the tolerance; false if nothing is to be done, or nothing can be.
/// The first time (`before` is empty then, and takes what was judged) by another motion, which keeps the coverage (refit_at_cuts), else
/// by a thinner tool, which is certain to be less deep (reduce_radius); the other one where that does not go.
[[nodiscard]] bool repair_judged_cuts(double tolerance_mm, std::optional<JudgedFit>& before, FitSearch& search,
                                      const VerifyReport& verify);

}  // namespace flank::internal
