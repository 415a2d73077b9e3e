/// A draft of the fit and what it covers: what passes hand on to one another.
#pragma once

#include <functional>
#include <vector>

#include "flank/fit/coverage.h"
#include "flank/fit/stages.h"

namespace flank::internal {

/// Poses per motion at which the estimate of the swept distance is tabulated when drafts are ranked: 2.5 for each of
/// the 64 control points that a rail can have, at least 3.3 for each of the 48 of all but the exact passes.
inline constexpr int kRankingPoses = 160;

/// Largest |c| where the flank touches its target, between this many poses of each motion and the next ones.
[[nodiscard]] double touching_c(const FitDraft& draft, double tolerance_mm, int poses);
/// |c| and turn of the motions as they will be written (motion/written_path.h): a cusp that lasts for a thousandth of a motion shows.
/// |c| is infinite for rails that cannot be.
void measure_written(const FitDraft& draft, const FlankFitOptions& options, CoverageEstimate& estimate);

/// Residuals far beyond this are outliers to a robust pass; mm.
[[nodiscard]] double robust_scale(const Target& target, const FlankFitOptions& options);

/// What of a target counts as out of reach: points where a ball of this radius, touching the target, enters a check
/// face by more than the depth (MATH section 9) or, if corners count, the target itself.
struct ReachLimits {
  double radius_mm = 0.0, depth_mm = 0.0;
  bool corners = false;
};

/// The limits of a fit: with a ball that the part and the demand choose, and within the tolerance. Corners count for such a
/// ball alone: that a given tool does not fit into the target is no excuse of it.
[[nodiscard]] ReachLimits reach_of(const FlankFitOptions& options);

/// Is the sample in reach, beside obstacles (none: nullptr)?
[[nodiscard]] bool is_reachable(const Target& target, const ObstacleField* obstacles, const SurfaceSample& sample,
                                const ReachLimits& reach);

/// Samples of the target that rank drafts, spacing options.sample_share sqrt(area). Samples out of reach, in the target's
/// own corners or because of obstacles, have the negative of their area: they count for overcut and for the share of the whole. Points of the
/// rim have none: they count for overcut alone.
[[nodiscard]] std::vector<SurfaceSample> ranking_samples(const Target& target, const ObstacleField* obstacles,
                                                         const FlankFitOptions& options);

/// Radius of the ball that says what is in reach, mm: the one given, else the smallest allowed to the tool.
[[nodiscard]] double reach_radius(const FlankFitOptions& options);

struct Polished {
  FitDraft draft;
  CoverageEstimate estimate;  ///< of this draft
  bool exact = false;         ///< the target is an envelope of such a tool, by the residual after the polish
};

/// Overcut that an exact fit may keep, mm: to take it away costs the motion its last digits. FitBudget::exact_overcut, and as much as the
/// triangles of a mesh lie off the surface that it is exact for, as far as any fit may cut.
[[nodiscard]] double exact_overcut(const FitDraft& draft, double tolerance_mm);

/// Asked between passes: whether no more of them are wanted.
using IsEnough = std::function<bool(const Polished&)>;

/// The draft with a free tool clamped into its bounds, and what it covers: nothing, at an infinite depth, if it has lost
/// its values.
[[nodiscard]] Polished assess(FitDraft draft, const std::vector<SurfaceSample>& samples,
                              const FlankFitOptions& options);
/// The same; `refined`: of what it covers (estimate_coverage).
[[nodiscard]] Polished assess(FitDraft draft, const std::vector<SurfaceSample>& samples, const FlankFitOptions& options,
                              Refined refined);

}  // namespace flank::internal
