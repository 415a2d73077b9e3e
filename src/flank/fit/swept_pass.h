/// The passes on the swept distance (swept_model.h): what differs between them, and what they have in common.
#pragma once

#include <vector>

#include "flank/base/tolerance_budget.h"
#include "flank/fit.h"
#include "flank/fit/model/swept_model.h"
#include "flank/fit/stages.h"

namespace flank::internal {

/// What differs between the passes.
struct SweptPass {
  double dead_zone;     ///< in tolerances
  double fairness;      ///< share of a tolerance's square (fairness_of)
  double anchor;        ///< FitStage::transversal_anchor
  int control_points;   ///< per rail
  int coefficients;     ///< of a free tool
  int iterations;       ///< at most
  int points_per_side;  ///< of the target; the judge's samples are several times denser
  /// In tolerances. At this distance material left has a quarter of its weight: what a strip cannot reach must not pull
  /// it off what it can.
  double out_of_sight = 20.0;
  /// Of overcut and of what other faces are entered by, in that of most passes.
  double firmness = 1.0;
};

/// Grid of the regularisers (the residuals are at points of the face), as the tolerance pass has it: 2.5 times for each
/// of 48 control points.
inline constexpr int kSamplesT = 120, kSamplesS = 36;

/// Fairness of rails that a machine runs well, and of rails that only just do not wave: rails that bend by the target's
/// size cost as much as a mean error of a tenth of the tolerance, and of 0.003 of it.
inline constexpr double kFair = 1e-2, kSoft = 1e-5, kSofter = 1e-6;

/// The dead zone of most passes.
inline constexpr double kWideZone = kToleranceBudget.fit.dead_zone;

/// The first pass keeps the anchor of the passes at the axis. The others need none, because a motion that shrinks
/// leaves points of the face uncovered; what is left of it fixes the timing, to which the swept distance is blind.
inline constexpr double kFirstAnchor = 1e-2, kNoAnchor = 1e-7;

/// First the change of residual, cheap: few points, few iterations, control points as after the tolerance pass.
inline constexpr SweptPass kArrive = {.dead_zone = kWideZone,
                                      .fairness = kFair,
                                      .anchor = kFirstAnchor,
                                      .control_points = 32,
                                      .coefficients = 16,
                                      .iterations = 12,
                                      .points_per_side = 25};
/// More control points, but fair. If that is enough, all later passes stay fair.
inline constexpr SweptPass kFairRails = {.dead_zone = kWideZone,
                                         .fairness = kFair,
                                         .anchor = kNoAnchor,
                                         .control_points = 48,
                                         .coefficients = 24,
                                         .iterations = 25,
                                         .points_per_side = 30};
/// If it is not, soft ones.
inline constexpr SweptPass kSoftRails = {.dead_zone = kWideZone,
                                         .fairness = kSoft,
                                         .anchor = kNoAnchor,
                                         .control_points = 48,
                                         .coefficients = 24,
                                         .iterations = 40,
                                         .points_per_side = 30};
/// The same on points dense enough (2,500) to see what 48 control points can do between them.
inline constexpr SweptPass kDense = {.dead_zone = kWideZone,
                                     .fairness = kSoft,
                                     .anchor = kNoAnchor,
                                     .control_points = 48,
                                     .coefficients = 24,
                                     .iterations = 15,
                                     .points_per_side = 50};
/// Half the dead zone: lowers the largest error (docs/algorithms/fit.md).
inline constexpr SweptPass kNarrow = {.dead_zone = 0.5 * kWideZone,
                                      .fairness = kSoft,
                                      .anchor = kNoAnchor,
                                      .control_points = 48,
                                      .coefficients = 24,
                                      .iterations = 15,
                                      .points_per_side = 50};
/// No dead zone: plain least squares, which lowers the mean error where nothing more is to be covered.
inline constexpr SweptPass kMean = {.dead_zone = 0.0,
                                    .fairness = kSoft,
                                    .anchor = kNoAnchor,
                                    .control_points = 48,
                                    .coefficients = 24,
                                    .iterations = 12,
                                    .points_per_side = 50};

/// If less is covered, coverage has more to gain than the mean: there is no pass without a dead zone, which gives up coverage
/// for the mean, and there are passes that give up what is out of reach (partial_polish.h).
inline constexpr double kAllButCovered = 0.995;

/// What of a target counts as out of reach: points where a ball of this radius, touching the target, enters a check
/// face by more than the depth (MATH section 9). Not used without obstacles.
struct ReachLimits {
  double radius_mm = 0.0, depth_mm = 0.0;
};

/// The limits of a fit: with a ball that the part and the demand choose, and within the tolerance.
[[nodiscard]] ReachLimits reach_of(const FlankFitOptions& options);

/// The weights and sizes of a pass, for targets of this size.
[[nodiscard]] FitStage swept_stage(const SweptPass& pass, const FlankFitOptions& options, double size_mm);

/// Points of the draft's targets, each target once, spacing about sqrt(area) / `per_side` (>= 1), rim included; shares
/// are by area. Points out of reach have that role, the others are to be touched.
[[nodiscard]] std::vector<FacePoint> target_points(const FitDraft& draft, int per_side, const ReachLimits& reach = {});

/// One pass of a SweptModel at the stage's resolution over these points; `trace` grows if given. Returns the result
/// whether it is better or not.
[[nodiscard]] FitDraft run_swept(const FitDraft& draft, const RadiusBounds& bounds, const FitStage& stage,
                                 std::vector<FacePoint> points, std::vector<IterationTrace>* trace);

}  // namespace flank::internal
