#include "flank/fit/partial_polish.h"

#include <algorithm>
#include <utility>

#include "flank/base/stopping.h"
#include "flank/fit/coverage.h"
#include "flank/fit/swept_pass.h"

namespace flank::internal {
namespace {

/// The points of a pass, and these places, which none of them saw.
std::vector<FacePoint> points_with(const std::vector<Vec3>& deep, const FitDraft& draft, const FlankFitOptions& options,
                                   int per_side) {
  std::vector<FacePoint> points = target_points(draft, per_side, reach_of(options));
  const double share = 1.0 / static_cast<double>(points.size());
  for (const Vec3& place : deep) points.push_back({place, share, FacePoint::Role::kTouch});
  return points;
}

}  // namespace

Polished partial_polish(const Polished& polished, const std::vector<SurfaceSample>& samples,
                        const FlankFitOptions& options, std::vector<IterationTrace>* trace) {
  /// Less is not worth the passes; or, where a caller would try a strip more, less than what they may complete.
  constexpr double kWorth = 0.5, kNear = 0.95;
  /// Holding passes: the places that one makes deep join the points of the next.
  constexpr int kHolds = 3;
  Polished best = polished;
  const double least = options.least_coverage_for_last_passes > 0.0 ? kNear : kWorth;
  if (best.estimate.at_tolerance < least || best.estimate.at_tolerance >= kAllButCovered) return best;
  const double tolerance = options.tolerance_mm, size = best.draft.targets.front()->diagonal();
  const auto pass_with = [&](const SweptPass& pass, const std::vector<Vec3>& deep) {
    std::vector<FacePoint> points = points_with(deep, best.draft, options, pass.points_per_side);
    const FitStage stage = swept_stage(pass, options, size);
    Polished trial = assess(run_swept(best.draft, options.bounds, stage, std::move(points), trace), samples, options);
    const bool better = trial.estimate.score(tolerance) > best.estimate.score(tolerance);
    if (better) best = std::move(trial);
    return better;
  };
  for (const SweptPass& pass : {kGiveUp, kGiveUpSoft})
    if (!stopping()) pass_with(pass, {});
  for (int k = 0; k < kHolds && !stopping(); ++k) {
    const std::vector<Vec3> deep = cut_deeper_than(kToleranceBudget.fit.settled_overcut * tolerance, samples,
                                                   best.draft.motions, best.draft.tool, kRankingPoses);
    if (!pass_with(kHold, deep)) break;
  }
  return best;
}

FitDraft pass_at(const FitDraft& draft, const std::vector<Vec3>& deep, const FlankFitOptions& options, double firmness,
                 double covered, double steadiness) {
  const SweptPass& pass = covered < kAllButCovered ? kHold : kDense;
  std::vector<FacePoint> points = points_with(deep, draft, options, pass.points_per_side);
  FitStage stage = swept_stage(pass, options, draft.targets.front()->diagonal());
  stage.bounds_at_knots = true;
  stage.clear_weight *= firmness;
  stage.plunge_weight *= steadiness;
  stage.lag_weight *= steadiness;
  if (firmness > 1.0) stage.clear_stride = 1;
  return run_swept(draft, options.bounds, stage, std::move(points), nullptr);
}

}  // namespace flank::internal
