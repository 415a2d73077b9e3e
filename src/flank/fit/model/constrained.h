/// The fit under hard limits on overcut (MATH section 7, the constrained step): f(x_k) >= -allowed_overcut_mm at points
/// to be touched, f(x_k) >= margin_mm at one-sided points, f the swept distance of swept_model.h.
///
/// Sequential quadratic programming; every convex step by an interior point. Points are exchanged: after each descent
/// the limits are checked on a dense set, and points that violate them join the constraints. Limits at points of the
/// face, not of the axis: held at the axis, the tool slides off what it is to cover (docs/algorithms/fit.md).
#pragma once

#include "flank/fit/model/swept_model.h"

namespace flank::internal {

struct ConstrainedOptions {
  /// The limit at points to be touched is f >= -allowed_overcut_mm; any sign. Negative keeps the tool that far off: set
  /// it to minus what a sphere can be deeper between two dense points, spacing^2 / (8 r).
  double allowed_overcut_mm = 0.0;
  /// mm, > 0: exchanging ends when the largest violation is at most this. Well below the margin above; smaller values
  /// only cost exchanges.
  double settled_mm = 1e-5;
  /// mm, > 0: points with f above this are no constraints of a step. Larger than any step moves the tool (the merit
  /// refuses steps that break limits left out); smaller is faster. run_constrained sets ten tolerances.
  double band_mm = 1.0;
  /// >= 1: steps of sequential quadratic programming between two exchanges. It mostly stops earlier, by its own test.
  int steps = 12;
  /// >= 0: rounds in which violated points join, at most 400 each. More if the result's violation_mm stays above
  /// settled_mm on a large target.
  int exchanges = 8;
  /// >= 10: iterations of one interior point at most. Ten full steps reach its end (0.15^10 < 1e-8); with 1,600 limits,
  /// of which many bind, it takes 20 to 22.
  int interior_iterations = 25;
};

/// What stays the same while points are exchanged.
struct ConstrainedProblem {
  std::vector<const Target*> targets;           ///< of each motion; not owned
  std::vector<const ObstacleField*> obstacles;  ///< as FitDraft; soft terms of the objective, not limits
  std::vector<int> free_parameters;             ///< of the tool; empty: the tool is given
  RadiusBounds bounds;                          ///< soft, as in FitModel
  FitStage stage;                               ///< weights of the objective; its iterations are not used
  std::vector<FacePoint> points;                ///< of the objective, and the first constraints
  std::vector<FacePoint> dense;                 ///< where the limits are checked; shares are not used
};

struct ConstrainedResult {
  FitState state;             ///< of the round with the smallest violation
  double violation_mm = 0.0;  ///< largest on the dense points; 0: all limits hold there. Judge by this, not by steps
  int steps = 0;              ///< of sequential quadratic programming, all rounds together
  int exchanged = 0;          ///< points that joined the constraints
};

/// Minimises the objective under the limits from `start`, which may violate them. start.motions must have
/// stage.control_points control points. Deterministic for any number of threads. Never throws for a problem that cannot
/// be satisfied: it returns the least violation it reached.
[[nodiscard]] ConstrainedResult minimise_constrained(const ConstrainedProblem& problem, const FitState& start,
                                                     const ConstrainedOptions& options);

}  // namespace flank::internal
