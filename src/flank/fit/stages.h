/// One pass of the fit after another, coarse and robust first, then fine: the presets of FitStage, and how a pass is
/// run. Which pass follows which is decided in finalists.cpp, polish.cpp and swept_polish.cpp.
#pragma once

#include <vector>

#include "flank/fit.h"
#include "flank/fit/model/fit_model.h"

namespace flank::internal {

/// FitStage::plunge_weight and lag_weight of all passes but the exact ones, in squares of tolerance over the target's
/// size: a motion that plunges or stands still for a twentieth of its time costs as much as a mean error of half the
/// tolerance.
inline constexpr double kPlungeShare = 100.0, kLagShare = 100.0;
/// FitStage::parallel_weight, likewise: sides whose axes each lean by a degree more than both on average cost as much as a
/// mean error of a tenth of the tolerance, if the axis is as long as the target.
inline constexpr double kParallelShare = 30.0;

/// Sets all three for a target of this size.
void set_motion_weights(FitStage& stage, double tolerance_mm, double size_mm);

/// FitStage::fairness at which rails that bend by the target's size over the motion (second differences of
/// size / (samples - 1)^2) cost as much as `share` of a mean square error of one tolerance. A weight of its own, mm against
/// mm, would leave rails free to wave at a loose tolerance, and stiffen them at a fine one.
[[nodiscard]] double fairness_of(double share, double tolerance_mm, double size_mm, int samples);

/// A tool and motions between passes, without footpoints. A value but for targets and obstacles, which are not owned.
struct FitDraft {
  std::vector<const Target*> targets;           ///< of each motion
  std::vector<const ObstacleField*> obstacles;  ///< of each motion; empty: nothing is in the way
  std::vector<RuledMotion> motions;             ///< all of one axis length
  RadialFunction tool;                          ///< over that length
  std::vector<int> free_parameters;             ///< of the tool; empty: given. Ignored if `free_tool`
  bool free_tool = false;                       ///< a spline whose number of coefficients a pass may change
  /// Motions 2 k and 2 k + 1 are over two sides of a cavity: passes draw their axes to the same lean, and stagger counts.
  bool facing = false;
};

/// The draft's targets, each once (strips side by side share one), in their order.
[[nodiscard]] std::vector<const Target*> distinct_targets(const FitDraft& draft);

/// What the flank must not enter when it is on this target; null: nothing.
[[nodiscard]] const ObstacleField* obstacles_of(const FitDraft& draft, const Target* target);

/// The stage without the terms that are not for this draft.
[[nodiscard]] FitStage stage_of(const FitDraft& draft, const FitStage& stage);

/// All control points and radii are numbers. A draft that has lost its values is no candidate.
[[nodiscard]] bool has_values(const FitDraft& draft);

/// Start of a pass: rails and spline at the stage's resolution (least squares through dense samples if it differs, so
/// the motion changes a little when control points become fewer). `next` becomes the draft with its list of free
/// parameters.
[[nodiscard]] FitState start_state(const FitDraft& draft, const FitStage& stage, FitDraft& next);

/// Brings the draft to the stage's number of control points and coefficients and minimises a FitModel. Returns the
/// result whether it is better or not: the caller assesses it. `trace` grows and `summary` is set if given.
[[nodiscard]] FitDraft run_stage(const FitDraft& draft, const RadiusBounds& bounds, const FitStage& stage,
                                 std::vector<IterationTrace>* trace = nullptr, ResidualSummary* summary = nullptr);

/// Tolerances at which quick fits are ranked (MATH section 7): rough as they are, at one tolerance most would cover
/// nothing, and by residual the wrong directions come first.
inline constexpr double kQuickTolerances = 4.0;
/// Poses per motion for that ranking: 6 for each of the 8 control points of a quick fit, half as dense again as
/// SweptModel's table.
inline constexpr int kQuickPoses = 48;
/// Their sample spacing, in square roots of the area: 400 samples tell fifty candidates apart, in a fifth of the time
/// that the samples of the later ranking take.
inline constexpr double kQuickSampleShare = 1.0 / 20.0;

/// Short robust pass for ranking starts: 8 control points per rail, milliseconds.
[[nodiscard]] FitStage quick_stage(double robust_scale_mm);
/// Least squares at the resolution of the papers (100 x 30, 24 control points). Robust past the border alone.
[[nodiscard]] FitStage polish_stage(double robust_scale_mm);
/// For targets that are envelopes (residual near zero): no fairness that would bias, no pull from extensions; the last
/// of them has more control points and all but no anchors.
[[nodiscard]] FitStage exact_stage(bool last);
/// For targets that are not: residuals count beyond FitBudget::dead_zone_axis, so that coverage grows instead of the mean falling. `size_mm` is that of the target.
[[nodiscard]] FitStage tolerance_stage(double tolerance_mm, double robust_scale_mm, double size_mm);

/// A spline's coefficients clamped to [smallest, largest]: the function lies in their hull, so it keeps the bounds too.
/// `steepest` is not enforced. A family is returned as it is: its parameters are no radii.
[[nodiscard]] RadialFunction clamp_tool(const RadialFunction& tool, const RadiusBounds& bounds);

}  // namespace flank::internal
