/// From a draft that a start or a quick fit gave to a result: the passes, the choice among them, the last corrections.
///
/// A pass is kept only if its result scores better on the same samples, so one that goes wrong costs time and nothing
/// else.
#pragma once

#include <vector>

#include "flank/fit/polished.h"

namespace flank::internal {

/// A draft for these tasks: the tool given, or a free spline of the mean distance of the axes to their targets (clamped
/// into the bounds). tasks is not empty; all motions have the axis length of the first.
[[nodiscard]] FitDraft make_draft(const std::vector<FitTask>& tasks, const ToolModel& tool,
                                  const FlankFitOptions& options);

/// A free tool to start from: radius at the tip, and r', 0 for a cylinder.
[[nodiscard]] RadialFunction start_tool(double axis_length, double radius, double slope, int coefficients);

/// A draft of these tasks for the quick pass: a free tool starts as a cylinder or, if r' is given, as a cone, with the number of coefficients
/// that the pass has. (make_draft measures the radius instead; here it is what tells the candidates apart.)
[[nodiscard]] FitDraft start_draft(const std::vector<FitTask>& tasks, const ToolModel& tool, double radius,
                                   double slope = 0.0);

/// Least squares, then either the exact passes (residual near zero) or the tolerance pass, then `reduce_overcut` radii for a
/// free tool. Returns the best that it saw by score, at worst the draft itself; `trace` grows if given.
[[nodiscard]] Polished polish(const FitDraft& draft, const std::vector<SurfaceSample>& samples,
                              const FlankFitOptions& options, std::vector<IterationTrace>* trace);

/// The passes of swept_polish.h if the target is no envelope, and a free tool's radii reduced against overcut. An exact
/// fit keeps its motion; a free tool's radii are reduced until FitBudget::exact_overcut is left. `enough`, `begun`: as
/// swept_polish has them.
[[nodiscard]] Polished last_passes(const Polished& polished, const std::vector<SurfaceSample>& samples,
                                   const FlankFitOptions& options, std::vector<IterationTrace>* trace,
                                   const IsEnough& enough = {}, bool begun = false);

/// Tolerances: what is cut or entered deeper than this needs another motion; repair_closely() does not mend it.
inline constexpr double kMendable = 5.0;

/// The same draft, assessed with samples four times denser than those that ranked it; a free tool's radii are reduced
/// if its overcut turns out to be above, or just below, the tolerance. Without this the ranking's samples, which the
/// passes have been chosen by, would flatter the result.
[[nodiscard]] Polished repair_closely(const Polished& polished, const FlankFitOptions& options);

/// The draft, assessed with the samples of the last look.
[[nodiscard]] Polished measured_closely(const FitDraft& draft, const FlankFitOptions& options);

/// Fills a result from the chosen draft: validation with cold footpoints, status, message. What `result` holds already
/// (before, trace, candidates) stays.
[[nodiscard]] FlankFitResult make_result(const Polished& polished, const FlankFitOptions& options,
                                         FlankFitResult result);

}  // namespace flank::internal
