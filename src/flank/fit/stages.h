/// One pass of the fit after another: coarse and robust first, then fine.
#pragma once

#include <vector>

#include "flank/fit/flank_fit.h"

namespace flank::internal {

/// A tool and motions between passes, without footpoints.
struct FitDraft {
  std::vector<const Target*> targets;
  std::vector<const FlankChecks*> checks;  ///< of each motion; empty: nothing is in the way
  std::vector<RuledMotion> motions;
  RadialFunction tool;
  std::vector<int> free_parameters;  ///< of the tool; ignored where `free_tool`
  bool free_tool = false;            ///< a spline whose number of coefficients a pass may change
};

/// The draft's targets, each once (strips side by side share one), in their order.
[[nodiscard]] std::vector<const Target*> distinct_targets(const FitDraft& draft);

/// What the flank must not enter on this target; null: nothing.
[[nodiscard]] const FlankChecks* checks_of(const FitDraft& draft, const Target* target);

/// Start of a pass: rails and spline at the stage's resolution; `next` becomes the draft with its list of free
/// parameters.
[[nodiscard]] FitState start_state(const FitDraft& draft, const FitStage& stage, FitDraft& next);

/// Brings the draft to the stage's number of control points and coefficients and minimises; `trace` grows if given.
[[nodiscard]] FitDraft run_stage(const FitDraft& draft, const RadiusBounds& bounds, const FitStage& stage,
                                 std::vector<IterationTrace>* trace = nullptr, ResidualSummary* summary = nullptr);

/// Short robust pass for ranking starts.
[[nodiscard]] FitStage quick_stage(double robust_scale_mm);
/// Least squares at the resolution of the papers (100 x 30, 24 control points).
[[nodiscard]] FitStage polish_stage(double robust_scale_mm);
/// For targets that are envelopes (residual near zero): no fairness that would bias, no pull from extensions; the last
/// of them has more control points and all but no anchors.
[[nodiscard]] FitStage exact_stage(bool last);
/// For targets that are not: residuals count beyond 0.7 tolerances, so that coverage grows instead of the mean falling.
[[nodiscard]] FitStage tolerance_stage(double tolerance_mm, double robust_scale_mm);

/// Tool parameters clamped into the bounds (splines: coefficients, whose hull holds the function).
[[nodiscard]] RadialFunction clamp_tool(const RadialFunction& tool, const RadiusBounds& bounds);

}  // namespace flank::internal
