/// What a minimiser of the fit returns.
#pragma once

#include <vector>

#include "flank/fit.h"
#include "flank/fit/model/fit_model.h"

namespace flank::internal {

enum class MinimiseStatus {
  kNotRun,
  kConverged,       ///< two accepted steps in a row lowered the cost by less than FitStage::step_tolerance, or cost = 0
  kIterationLimit,  ///< FitStage::iterations steps were accepted before that
  kStalled,  ///< no damping up to 1e8 lowered the cost, the step was round-off, or the start's cost is not finite
};

struct MinimiseResult {
  FitState state;  ///< the last accepted one
  MinimiseStatus status = MinimiseStatus::kNotRun;
  std::vector<IterationTrace> trace;  ///< first: the start; last: the result
};

}  // namespace flank::internal
