/// Levenberg-Marquardt over a FitModel, with iteratively reweighted samples.
#pragma once

#include <vector>

#include "flank/fit/model/fit_model.h"

namespace flank::internal {

enum class MinimiseStatus {
  kNotRun,
  kConverged,       ///< the last accepted step changed the cost by less than FitStage::step_tolerance of it
  kIterationLimit,  ///< FitStage::iterations accepted steps were made
  kStalled,         ///< no damping up to 1e8 gave a lower cost
};

/// What one iteration did: lengths in mm, over samples whose footpoint is inside the target.
struct IterationTrace {
  double cost = 0.0;
  double rms_mm = 0.0;
  double largest_mm = 0.0;
  double damping = 0.0;
};

struct MinimiseResult {
  FitState state;
  MinimiseStatus status = MinimiseStatus::kNotRun;
  std::vector<IterationTrace> trace;  ///< first: the start; last: the result
};

/// Minimises the model from `start`. The initial damping is 1e-9 of the mean diagonal (1e-6 crawls, MATH section 7).
[[nodiscard]] MinimiseResult minimise(const FitModel& model, FitState start);

/// Root mean square and largest |e| over samples inside the target; share of the samples that are inside.
struct ResidualSummary {
  double rms_mm = 0.0, largest_mm = 0.0, inside_share = 0.0;
  double largest_overcut_mm = 0.0;  ///< max(0, r - d)
};
[[nodiscard]] ResidualSummary summarise_residuals(const FitModel& model, const FitState& state);

}  // namespace flank::internal
