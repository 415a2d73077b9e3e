/// From a draft that a start or a quick fit gave to a result: the passes, the choice among them, the last corrections.
#pragma once

#include <vector>

#include "flank/fit/stages.h"

namespace flank::internal {

inline constexpr int kRankingPoses = 160;

/// Residuals far beyond this are outliers to a robust pass.
[[nodiscard]] double robust_scale(const Target& target, const FlankFitOptions& options);

/// Samples of the target that rank drafts. Those that check faces put out of reach have no area: they count for overcut
/// alone.
[[nodiscard]] std::vector<SurfaceSample> ranking_samples(const Target& target, const FlankChecks* checks,
                                                         const FlankFitOptions& options);

/// Radius of the ball that says what is in reach.
[[nodiscard]] double reach_radius(const FlankFitOptions& options);

/// A draft for these tasks: the tool given, or a free spline of the mean distance of the axes to their targets.
[[nodiscard]] FitDraft make_draft(const std::vector<FitTask>& tasks, const ToolModel& tool,
                                  const FlankFitOptions& options);

struct Polished {
  FitDraft draft;
  CoverageEstimate estimate;
  bool exact = false;  ///< the target is an envelope of such a tool
};

/// The draft with a free tool clamped into its bounds, and what it covers.
[[nodiscard]] Polished assess(FitDraft draft, const std::vector<SurfaceSample>& samples,
                              const FlankFitOptions& options);

/// Least squares, then either the exact passes (residual near zero) or the tolerance passes. Never returns worse than
/// the best it saw.
[[nodiscard]] Polished polish(const FitDraft& draft, const std::vector<SurfaceSample>& samples,
                              const FlankFitOptions& options, std::vector<IterationTrace>* trace);

/// The passes of swept_polish.h where the target is no envelope, and a free tool shifted against overcut.
[[nodiscard]] Polished last_passes(const Polished& polished, const std::vector<SurfaceSample>& samples,
                                   const FlankFitOptions& options, std::vector<IterationTrace>* trace);

/// Looked at again with samples several times denser than those that ranked it, and a free tool shifted if its overcut
/// turns out to be beyond the tolerance.
[[nodiscard]] Polished settled(const Polished& polished, const FlankFitOptions& options);

/// Fills a result from the chosen draft: validation with cold footpoints, status.
[[nodiscard]] FlankFitResult finish(const Polished& polished, const FlankFitOptions& options, FlankFitResult result);

}  // namespace flank::internal
