/// The passes on the swept distance (swept_model.h): what differs between them, and what they have in common.
#pragma once

#include <vector>

#include "flank/base/tolerance_budget.h"
#include "flank/fit.h"
#include "flank/fit/model/swept_model.h"
#include "flank/fit/polished.h"
#include "flank/fit/stages.h"

namespace flank::internal {

/// Grid of the regularisers (the residuals are at points of the face), as the tolerance pass has it: 2.5 times for each
/// of 48 control points.
inline constexpr int kSamplesT = 120, kSamplesS = 36;

/// Fairness of rails that a machine runs well, and of rails that only just do not wave: rails that bend by the target's
/// size cost as much as a mean error of a tenth of the tolerance, and of 0.003 of it.
inline constexpr double kFair = 1e-2, kSoft = 1e-5, kSofter = 1e-6;

/// The dead zone of most passes.
inline constexpr double kWideZone = kToleranceBudget.fit.dead_zone;

/// No pass but the first needs the anchor of the passes at the axis, because a motion that shrinks leaves points of the
/// face uncovered; what is left of it fixes the timing, to which the swept distance is blind.
inline constexpr double kNoAnchor = 1e-7;

/// What differs between the passes.
struct SweptPass {
  double dead_zone = kWideZone;  ///< in tolerances
  double fairness = kSoft;       ///< share of a tolerance's square (fairness_of)
  double anchor = kNoAnchor;     ///< FitStage::transversal_anchor
  int control_points = 48;       ///< per rail
  int coefficients = 24;         ///< of a free tool
  int iterations = 0;            ///< at most
  int points_per_side = 50;      ///< of the target; the judge's samples are several times denser
  /// In tolerances. At this distance material left has a quarter of its weight: what a strip cannot reach must not pull
  /// it off what it can.
  double out_of_sight = 20.0;
  /// Of overcut and of what other faces are entered by, in that of most passes.
  double firmness = 1.0;
};

/// Most passes: points dense enough (2,500) to see what 48 control points can do between them, soft rails.
inline constexpr SweptPass kDense = {.iterations = 15};

/// If less is covered, coverage has more to gain than the mean: there is no pass without a dead zone, which gives up coverage
/// for the mean, and there are passes that give up what is out of reach (partial_polish.h).
inline constexpr double kAllButCovered = 0.995;

/// The weights and sizes of a pass, for targets of this size.
[[nodiscard]] FitStage swept_stage(const SweptPass& pass, const FlankFitOptions& options, double size_mm);

/// Points of the draft's targets, each target once, spacing about sqrt(area / its strips) / `per_side` (>= 1), rim
/// included; shares are by area. Points out of reach have that role, the others are to be touched.
[[nodiscard]] std::vector<FacePoint> target_points(const FitDraft& draft, int per_side, const ReachLimits& reach = {});

/// One pass of a SweptModel at the stage's resolution over these points; `trace` grows if given. Returns the result
/// whether it is better or not.
[[nodiscard]] FitDraft run_swept(const FitDraft& draft, const RadiusBounds& bounds, const FitStage& stage,
                                 std::vector<FacePoint> points, std::vector<IterationTrace>* trace);

}  // namespace flank::internal
