/// The passes on the swept distance (swept_pass.h), as one table: each is a row of figures, and nothing else tells one from another. Which
/// follows which is said where they are run: swept_polish.cpp, partial_polish.cpp, reach_further.cpp.
#pragma once

#include <array>

#include "flank/base/tolerance_budget.h"

namespace flank::internal {

/// Grid of the regularisers (the residuals are at points of the face), as the tolerance pass has it: 2.5 times for each
/// of 48 control points.
inline constexpr int kSamplesT = 120, kSamplesS = 36;

/// Fairness of rails that a machine runs well, of rails that only just do not wave, and of rails between them: rails that bend by the
/// target's size cost as much as a mean error of a tenth of the tolerance, of 0.003 of it, and of 0.017.
inline constexpr double kFair = 1e-2, kSoft = 1e-5, kSofter = 1e-6, kYielding = 3e-4;

/// The dead zone of most passes, and of those that give up what is beyond the tolerance: nothing within it is to be improved.
inline constexpr double kWideZone = kToleranceBudget.fit.dead_zone,
                        kPartialZone = kToleranceBudget.fit.dead_zone_partial;

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

/// First the change of residual, cheap: few points, few iterations, control points and anchor as in the tolerance pass.
inline constexpr SweptPass kArrive = {.fairness = kFair,
                                      .anchor = 1e-2,
                                      .control_points = 32,
                                      .coefficients = 16,
                                      .iterations = 12,
                                      .points_per_side = 25};
/// More control points, but fair. If that is enough, all later passes stay fair.
inline constexpr SweptPass kFairRails = {.fairness = kFair, .iterations = 25, .points_per_side = 30};
/// If it is not, soft ones.
inline constexpr SweptPass kSoftRails = {.iterations = 40, .points_per_side = 30};
/// Points dense enough (2,500) to see what 48 control points can do between them, soft rails.
inline constexpr SweptPass kDense = {.iterations = 15};
/// Half the dead zone: lowers the largest error (docs/algorithms/fit.md).
inline constexpr SweptPass kNarrow = {.dead_zone = 0.5 * kWideZone, .iterations = 15};
/// No dead zone: plain least squares, which lowers the mean error where nothing more is to be covered.
inline constexpr SweptPass kMean = {.dead_zone = 0.0, .iterations = 12};

/// Where one strip cannot do all that is asked: what is beyond the tolerance is given up, so that it no longer pulls at what
/// is within, and overcut weighs more, because that has to be taken back by radii that cost coverage everywhere. First
/// to the softer weights, then to those that hold.
inline constexpr SweptPass kGiveUp = {
    .dead_zone = kPartialZone, .iterations = 30, .out_of_sight = 1.0, .firmness = 4.0};
inline constexpr SweptPass kGiveUpSoft = {.fairness = kSofter, .iterations = 30, .out_of_sight = 1.0, .firmness = 4.0};
inline constexpr SweptPass kHold = {
    .dead_zone = kPartialZone, .fairness = kSofter, .iterations = 30, .out_of_sight = 1.0, .firmness = 16.0};
/// Over what the tool's own balls touch: what is far is out of sight, so that it pulls little at what is within.
inline constexpr SweptPass kFurther = {
    .dead_zone = kPartialZone, .fairness = kSofter, .iterations = 20, .out_of_sight = 4.0, .firmness = 4.0};

/// In the order of their passes.
inline constexpr std::array<SweptPass, 2> kFirstPasses = {kArrive, kFairRails};
inline constexpr std::array<SweptPass, 4> kOtherPasses = {kSoftRails, kDense, kNarrow, kMean};

}  // namespace flank::internal
