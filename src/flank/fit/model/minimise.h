/// Levenberg-Marquardt over a FitModel (the loop is in levenberg_marquardt.h).
#pragma once

#include "flank/fit/model/minimise_result.h"

namespace flank::internal {

/// levenberg_marquardt.h on a FitModel, compiled once.
[[nodiscard]] MinimiseResult minimise(const FitModel& model, FitState start);

/// Of a located state (its feet filled by FitModel::locate).
[[nodiscard]] ResidualSummary summarise_residuals(const FitModel& model, const FitState& state);

}  // namespace flank::internal
