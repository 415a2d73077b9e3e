/// The last passes of a fit that is no exact envelope: on the swept distance at fixed points of the faces
/// (swept_model.h).
#pragma once

#include <vector>

#include "flank/fit/model/swept_model.h"
#include "flank/fit/polished.h"

namespace flank::internal {

/// What of a target counts as out of reach: points where a ball of this radius, touching the target, enters a check
/// face by more than the depth (MATH section 9). Not used without obstacles.
struct ReachLimits {
  double radius_mm = 0.0, depth_mm = 0.0;
};

/// Points of the draft's targets, each target once, spacing about sqrt(area) / `per_side` (>= 1), rim included; shares
/// are by area. Points out of reach have that role, the others are to be touched.
[[nodiscard]] std::vector<FacePoint> target_points(const FitDraft& draft, int per_side, const ReachLimits& reach = {});

/// One pass of a SweptModel at the stage's resolution over these points; `trace` grows if given. Returns the result
/// whether it is better or not.
[[nodiscard]] FitDraft run_swept(const FitDraft& draft, const RadiusBounds& bounds, const FitStage& stage,
                                 std::vector<FacePoint> points, std::vector<IterationTrace>* trace);

/// The same under a hard limit on overcut (constrained.h), with a margin for what lies between the points; points
/// farther than `band_mm` from the tool are not held.
[[nodiscard]] FitDraft run_constrained(const FitDraft& draft, const RadiusBounds& bounds, const FitStage& stage,
                                       double band_mm, const ReachLimits& reach);

/// Passes with a dead zone that narrows while the rails grow softer; each is kept only if it scores better on
/// `samples`.
[[nodiscard]] Polished swept_polish(const Polished& polished, const std::vector<SurfaceSample>& samples,
                                    const FlankFitOptions& options, std::vector<IterationTrace>* trace);

/// Of motions over facing sides, found without a look at each other: passes that draw the axes of both sides to the same lean, firmer each
/// time, kept while `least_coverage` of the samples (or what there was, if that is less) stays covered, and nothing is cut or
/// entered deeper than allowed. How far an axis leans along its way is hardly felt by a wall that is hardly curved along it.
[[nodiscard]] Polished straightened(const Polished& polished, double least_coverage,
                                    const std::vector<SurfaceSample>& samples, const FlankFitOptions& options,
                                    std::vector<IterationTrace>* trace);

/// For a free tool on a target that seems to be its envelope (mean error over the samples below 3e-5 of the size, nearly
/// all of it covered): two passes without a dead zone, and with all but no weights but the error's. Residuals are those of
/// the face, so the rim is held, which passes at the axis let go. Kept as far as mean error and overcut fall and
/// nothing is lost; given up after the first pass if it is no envelope.
[[nodiscard]] Polished last_digits(const Polished& polished, const std::vector<SurfaceSample>& samples,
                                   const FlankFitOptions& options, std::vector<IterationTrace>* trace);

/// A tool whose shape is given cannot shrink: its overcut is taken out by the constrained pass, at the price of
/// material left. Returns its argument for a free tool, if there is no overcut worth removing, or if the pass did not
/// lower it.
[[nodiscard]] Polished without_overcut(const Polished& polished, const std::vector<SurfaceSample>& samples,
                                       const FlankFitOptions& options);

/// One more pass of a draft that cuts deeper than allowed at `deep`, places of the target that no pass has seen (the
/// passes see 2,500 points, a last look many more): they join the points. A free tool's bounds are asked at its knots,
/// too. `firmness` >= 1: weight of what other faces are entered by, in that of other passes; above 1 every sample asks for
/// them. Not assessed: by which samples it is measured is for the caller to say.
[[nodiscard]] FitDraft pass_at(const FitDraft& draft, const std::vector<Vec3>& deep, const FlankFitOptions& options,
                               double firmness);

/// One more pass, with fair rails, of a draft that plunges where it touches. `firmness` >= 1: weight of what plunges and of
/// what lags, in that of other passes. A free tool's bounds are asked at its knots, too. Not assessed, as pass_at.
[[nodiscard]] FitDraft steady_pass(const FitDraft& draft, const FlankFitOptions& options, double firmness);

}  // namespace flank::internal
