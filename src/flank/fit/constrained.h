/// The fit under hard limits on overcut: d(R(s,t)) - r(s) >= -allowed for every sample (MATH section 7, the constrained
/// step).
#pragma once

#include "flank/fit/fit_model.h"

namespace flank {

struct ConstrainedOptions {
  double allowed_overcut_mm = 0.0;
  int steps = 12;       ///< of sequential quadratic programming
  int refinements = 6;  ///< rounds in which samples next to an overcut on a 3 times denser grid get a margin
  int interior_iterations = 30;
};

struct ConstrainedResult {
  FitState state;
  double overcut_mm = 0.0;    ///< largest r - d on the dense grid, against the real (not extended) target
  double violation_mm = 0.0;  ///< largest violation on the model's own samples
  int steps = 0;
};

/// Minimises the model's cost (its stage should be plain least squares) under the limits, from `start`. Each step
/// solves the convex problem of the linearised gaps by a primal-dual interior-point method; samples past the border are
/// held off the real face, whose border they may not enter.
[[nodiscard]] ConstrainedResult minimise_constrained(const FitModel& model, FitState start,
                                                     const ConstrainedOptions& options);

}  // namespace flank
