#include "flank/fit/flank_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "flank/fit/swept_polish.h"

namespace flank::internal {

FlankFitResult fit_from_starts(const std::vector<FitTask>& tasks, const ToolModel& tool, const FlankFitOptions& options,
                               const Progress& progress) {
  FlankFitResult result;
  const std::vector<SurfaceSample> samples = ranking_samples(*tasks.front().target, tasks.front().obstacles, options);
  // The start is the user's: no quick fit, which would move it towards what ranks best, and no other candidates.
  FitDraft draft = make_draft(tasks, tool, options);
  progress.step("fit", 0.1);
  result.before = estimate_coverage(samples, draft.motions, draft.tool, options.tolerance_mm, kRankingPoses);
  const Polished polished = without_overcut(
      last_passes(polish(draft, samples, options, &result.trace), samples, options, &result.trace), samples, options);
  progress.step("fit", 0.9);
  return finish(settled(polished, options), options, std::move(result));
}

}  // namespace flank::internal
