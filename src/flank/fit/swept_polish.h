/// The last passes of a fit that is no exact envelope: on the swept distance at fixed points of the faces
/// (swept_model.h).
#pragma once

#include <vector>

#include "flank/fit/polished.h"
#include "flank/fit/swept_pass.h"

namespace flank::internal {

/// A pass (swept_pass.h) under a hard limit on overcut (constrained.h), with a margin for what lies between the points; points
/// farther than `band_mm` from the tool are not held.
[[nodiscard]] FitDraft run_constrained(const FitDraft& draft, const RadiusBounds& bounds, const FitStage& stage,
                                       double band_mm, const ReachLimits& reach);

/// Passes with a dead zone that narrows while the rails grow softer; each is kept only if it scores better on
/// `samples`. The best so far is the result as soon as it is `enough`, if that is given. `begun`: the first passes have been.
[[nodiscard]] Polished swept_polish(const Polished& polished, const std::vector<SurfaceSample>& samples,
                                    const FlankFitOptions& options, std::vector<IterationTrace>* trace,
                                    const IsEnough& enough = {}, bool begun = false);

/// Its first two, cheap: they tell whether a fit that covers little at the axis leads anywhere. Beside walls the residual at the
/// axis leaves out what the walls keep a tool from, and what is covered can be a fifth more after them.
[[nodiscard]] Polished first_passes(const Polished& polished, const std::vector<SurfaceSample>& samples,
                                    const FlankFitOptions& options, std::vector<IterationTrace>* trace);

/// Of motions over facing sides, found without a look at each other: passes that draw the axes of both sides to the same lean, firmer each
/// time, kept while `least_coverage` of the samples (or what there was, if that is less) stays covered, and nothing is cut or
/// entered deeper than allowed. How far an axis leans along its way is hardly felt by a wall that is hardly curved along it.
[[nodiscard]] Polished reduce_stagger(const Polished& polished, double least_coverage,
                                      const std::vector<SurfaceSample>& samples, const FlankFitOptions& options,
                                      std::vector<IterationTrace>* trace);

/// On a target that seems to be the tool's envelope (mean error over the samples below 3e-5 of the size, of a given tool, which may have
/// been lifted, 1e-4, and nearly all of it covered): two passes without a dead zone, and with all but no weights but the error's. Residuals are those of
/// the face, so the rim is held, which passes at the axis let go. Kept as far as mean error and overcut fall and
/// nothing is lost; given up after the first pass if it is no envelope.
[[nodiscard]] Polished refine_exact_envelope(const Polished& polished, const std::vector<SurfaceSample>& samples,
                                             const FlankFitOptions& options, std::vector<IterationTrace>* trace);

/// A tool whose shape is given cannot shrink: its overcut is taken out by the constrained pass, at the price of
/// material left. Returns its argument for a free tool, if there is no overcut worth removing, or if the pass did not
/// lower it.
[[nodiscard]] Polished without_overcut(const Polished& polished, const std::vector<SurfaceSample>& samples,
                                       const FlankFitOptions& options);

/// One more pass, with fair rails, of a draft that plunges where it touches. `firmness` >= 1: weight of what plunges and of
/// what lags, in that of other passes. A free tool's bounds are asked at its knots, too. Not assessed, as pass_at.
[[nodiscard]] FitDraft steady_pass(const FitDraft& draft, const FlankFitOptions& options, double firmness);

}  // namespace flank::internal
