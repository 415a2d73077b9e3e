/// The passes on the swept distance (swept_model.h): what differs between them, and what they have in common.
#pragma once

#include <vector>

#include "flank/fit.h"
#include "flank/fit/model/swept_model.h"
#include "flank/fit/passes.h"
#include "flank/fit/polished.h"
#include "flank/fit/stages.h"

namespace flank::internal {

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
