#include "flank/pipeline/search/reach_further.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "flank/base/assert.h"
#include "flank/base/journal.h"
#include "flank/base/parallel.h"
#include "flank/base/stopping.h"
#include "flank/base/tolerance_budget.h"
#include "flank/envelope/swept_estimate.h"
#include "flank/fit/coverage.h"
#include "flank/fit/fit_record.h"
#include "flank/fit/polish.h"
#include "flank/fit/rank.h"
#include "flank/fit/rejected.h"
#include "flank/fit/swept_pass.h"

namespace flank::internal {
namespace {

/// Samples that rank drafts, of all targets.
std::vector<SurfaceSample> ranking_of_all(const FitDraft& draft, const FlankFitOptions& options) {
  std::vector<SurfaceSample> samples;
  for (const Target* target : distinct_targets(draft)) {
    const std::vector<SurfaceSample> more = ranking_samples(*target, obstacles_of(draft, target), options);
    samples.insert(samples.end(), more.begin(), more.end());
  }
  return samples;
}

/// What is covered of the whole targets, in reach or not.
struct WholeCoverage {
  double share = 0.0;  ///< of the area, within the tolerance
  double soft = 0.0;   ///< the same, with a part of what is little beyond it: samples of a narrow face lie in few rows
};

WholeCoverage of_whole(const FitDraft& draft, const FlankFitOptions& options) {
  constexpr double kDenser = 2.0;  // in each direction, than what ranks drafts
  const double tolerance = options.tolerance_mm;
  const SweptEstimate swept(draft.motions, draft.tool, kRankingPoses);
  WholeCoverage found;
  double area = 0.0;
  for (const Target* target : distinct_targets(draft)) {
    const auto samples = target->samples(std::sqrt(target->area()) * options.sample_share / kDenser);
    std::vector<double> beyond(samples.size());
    parallel_for(samples.size(), [&](std::size_t k) {
      beyond[k] = std::max(0.0, std::abs(swept.nearest(samples[k].point).f) / tolerance - 1.0);
    });
    for (std::size_t k = 0; k < samples.size(); ++k) {
      area += samples[k].area;
      if (beyond[k] <= 0.0) found.share += samples[k].area;
      found.soft += samples[k].area / (1.0 + beyond[k] * beyond[k]);
    }
  }
  if (area > 0.0) found = {found.share / area, found.soft / area};
  return found;
}

/// What a tool's own balls touch, beside the demanded one's.
ReachLimits own_reach(const FitDraft& draft, const FlankFitOptions& options) {
  ReachLimits reach = reach_of(options);
  reach.radius_mm = std::min(reach.radius_mm, draft.tool.smallest());
  return reach;
}

/// Share of the whole targets that the tool's own balls touch and its motions leave.
double left_in_reach(const FitDraft& draft, const FlankFitOptions& options) {
  const SweptEstimate swept(draft.motions, draft.tool, kRankingPoses);
  const ReachLimits reach = own_reach(draft, options);
  double left = 0.0, area = 0.0;
  for (const Target* target : distinct_targets(draft)) {
    const auto samples = target->samples(std::sqrt(target->area()) * options.sample_share);
    std::vector<double> areas(samples.size(), 0.0);
    parallel_for(samples.size(), [&](std::size_t k) {
      const bool covered = std::abs(swept.nearest(samples[k].point).f) <= options.tolerance_mm;
      if (!covered && is_reachable(*target, obstacles_of(draft, target), samples[k], reach)) areas[k] = samples[k].area;
    });
    for (std::size_t k = 0; k < samples.size(); ++k) left += areas[k];
    area += target->area();
  }
  return left / area;
}

/// A draft, what it covers of what is in reach, and of the whole.
struct Extended {
  Polished polished;
  WholeCoverage whole;
};

/// By how much it covers more than another one, of the whole or of what is in reach; negative if it covers less of the whole.
double gain(const Extended& now, const Extended& before) {
  if (now.whole.share < before.whole.share) return now.whole.share - before.whole.share;
  return std::max(now.whole.soft - before.whole.soft,
                  now.polished.estimate.at_tolerance - before.polished.estimate.at_tolerance);
}

/// A pass over what the tool's own balls touch. What is far is out of sight, so that it pulls little at what is within.
/// `steadiness`: weight of what plunges and of what lags, in that of other passes.
FitDraft further_pass(const FitDraft& draft, const FlankFitOptions& options, double steadiness) {
  FitStage stage = swept_stage(kFurther, options, draft.targets.front()->diagonal());
  stage.plunge_weight *= steadiness;
  stage.lag_weight *= steadiness;
  return run_swept(draft, options.bounds, stage,
                   target_points(draft, kFurther.points_per_side, own_reach(draft, options)), nullptr);
}

/// Nothing of what was asked is given up: what is in reach stays covered, nothing is entered, the flank does not plunge, and the
/// tool is no more slender than it may be, or was.
bool gives_up_nothing(const Polished& now, const Polished& before, const FlankFitOptions& options) {
  const bool stiff = is_stiff(now.estimate, options) || now.estimate.slenderness <= before.estimate.slenderness;
  return now.estimate.at_tolerance >= before.estimate.at_tolerance && is_clean(now.estimate, options.tolerance_mm) &&
         is_steady(now.estimate) && stiff;
}

/// Passes as long as they gain.
Extended passed_further(const Extended& start, const std::vector<SurfaceSample>& samples,
                        const FlankFitOptions& options, double steadiness) {
  constexpr double kGoesOn = 0.005;  // of the whole: a pass that gains less is the last
  constexpr int kMost = 3;
  Extended best = start;
  for (int k = 0; k < kMost && !stopping(); ++k) {
    Polished trial = assess(further_pass(best.polished.draft, options, steadiness), samples, options);
    if (!has_values(trial.draft)) break;
    const WholeCoverage whole = of_whole(trial.draft, options);
    Extended next{std::move(trial), whole};
    const double more = gain(next, best);
    if (more > 0.0) best = std::move(next);
    if (more < kGoesOn) break;
  }
  return best;
}

FlankFitResult extend_coverage(const std::vector<FitTask>& tasks, const FlankFitResult& found, const ToolModel& tool,
                               const FlankFitOptions& options) {
  constexpr double kWorth = 0.001;  // of the target: what the samples can tell
  constexpr std::array kSteadiness = {1.0, 10.0};
  Extended start;
  start.polished.draft = make_draft(tasks, tool, options);
  start.polished.draft.motions = found.motions;
  start.polished.draft.tool = found.tool;
  start.polished.estimate = found.after;
  if (left_in_reach(start.polished.draft, options) <= 1.0 - kAllButCovered) return found;
  start.whole = of_whole(start.polished.draft, options);
  const std::vector<SurfaceSample> samples = ranking_of_all(start.polished.draft, options);
  for (const double steadiness : kSteadiness) {
    Extended further = passed_further(start, samples, options, steadiness);
    if (stopping() || gain(further, start) < kWorth) break;  // a steadier motion would not, either
    further.polished = repair_closely(further.polished, options);
    further.whole = of_whole(further.polished.draft, options);
    if (gives_up_nothing(further.polished, start.polished, options) && gain(further, start) >= kWorth)
      return make_result(further.polished, options, found);
  }
  return found;
}

}  // namespace

FlankFitResult reach_further(const std::vector<FitTask>& tasks, const FlankFitResult& found, const ToolModel& tool,
                             const FlankFitOptions& options, const Progress& progress) {
  FLANK_ASSERT(tasks.size() == found.motions.size());
  const bool sound =
      is_clean(found.after, options.tolerance_mm) && is_steady(found.after);  // else it has more to give up
  if (tasks.empty() || progress.stop() || !sound) return found;
  return journaled(
      progress, "reach further", [&] { return extend_coverage(tasks, found, tool, options); }, found);
}

}  // namespace flank::internal
