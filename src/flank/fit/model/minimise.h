/// What a minimiser of the fit returns, and Levenberg-Marquardt over a FitModel (the loop is in levenberg_marquardt.h).
#pragma once

#include <vector>

#include "flank/fit/model/fit_model.h"

namespace flank::internal {

enum class MinimiseStatus {
  kNotRun,
  kConverged,       ///< two accepted steps in a row lowered the cost by less than FitStage::step_tolerance, or cost = 0
  kIterationLimit,  ///< FitStage::iterations steps were accepted before that
  kStalled,  ///< no damping up to 1e8 lowered the cost, the step was round-off, or the start's cost is not finite
};

/// What one iteration did, over samples whose footpoint is inside the target (of a SweptModel: points to be touched).
struct IterationTrace {
  double cost = 0.0;        ///< mm^2: weighted squares and regularisers, under the weights in force at that iteration
  double rms_mm = 0.0;      ///< of the residuals, unweighted, without dead zone
  double largest_mm = 0.0;  ///< |residual|, unweighted
  double damping = 0.0;     ///< for the next step; no unit
};

struct MinimiseResult {
  FitState state;  ///< the last accepted one
  MinimiseStatus status = MinimiseStatus::kNotRun;
  std::vector<IterationTrace> trace;  ///< first: the start; last: the result
};

/// levenberg_marquardt.h on a FitModel, compiled once.
[[nodiscard]] MinimiseResult minimise(const FitModel& model, FitState start);

/// Residuals e = d - r over samples inside the target. These are errors at the axis: on a target that is no envelope
/// the real error can be 20 times larger (MATH section 7). All zero if no sample is inside.
struct ResidualSummary {
  double rms_mm = 0.0;              ///< root mean square of e
  double largest_mm = 0.0;          ///< |e|
  double inside_share = 0.0;        ///< of all samples, in [0, 1]; of a SweptModel: 1
  double largest_overcut_mm = 0.0;  ///< max(0, -e)
};
/// Of a located state (its feet filled by FitModel::locate).
[[nodiscard]] ResidualSummary summarise_residuals(const FitModel& model, const FitState& state);

}  // namespace flank::internal
