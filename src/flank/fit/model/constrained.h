/// The fit under hard limits on overcut (MATH section 7, the constrained step): f(x_k) >= -allowed at points of the
/// target, f(x_k) >= margin at points of check surfaces, f the swept distance of swept_model.h.
///
/// Sequential quadratic programming; every convex step by an interior point. Points are exchanged: after each descent
/// the limits are tried on a dense set, and points that break them join the constraints.
#pragma once

#include "flank/fit/model/swept_model.h"

namespace flank::internal {

struct ConstrainedOptions {
  double allowed_overcut_mm = 0.0;
  double settled_mm = 1e-5;  ///< a violation that is as good as none
  double band_mm = 1.0;      ///< points with f above this are no constraints of a step
  int steps = 12;            ///< of sequential quadratic programming between two exchanges
  int exchanges = 8;
  int interior_iterations = 25;
};

/// What stays the same while points are exchanged.
struct ConstrainedProblem {
  std::vector<const Target*> targets;
  std::vector<const FlankChecks*> checks;  ///< as FitDraft; soft terms of the objective
  std::vector<int> free_parameters;
  RadiusBounds bounds;
  FitStage stage;                 ///< dead zone 0
  std::vector<FacePoint> points;  ///< of the objective, and the first constraints
  std::vector<FacePoint> dense;   ///< where the limits are tried
};

struct ConstrainedResult {
  FitState state;
  double violation_mm = 0.0;  ///< largest on the dense points
  int steps = 0, exchanged = 0;
};

[[nodiscard]] ConstrainedResult minimise_constrained(const ConstrainedProblem& problem, const FitState& start,
                                                     const ConstrainedOptions& options);

}  // namespace flank::internal
