#include "flank/fit.h"
#include "flank/base/stopping.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>

#include "flank/base/assert.h"
#include "flank/base/journal.h"
#include "flank/base/parallel.h"
#include "flank/fit/coverage.h"
#include "flank/fit/finalists.h"
#include "flank/fit/fit_record.h"
#include "flank/fit/orbit/orbit_fit.h"
#include "flank/fit/polish.h"
#include "flank/fit/rank.h"
#include "flank/fit/rejected.h"
#include "flank/fit/starts/start_tasks.h"
#include "flank/fit/starts/upper_end.h"
#include "flank/fit/ways.h"
#include "flank/motion/motion_record.h"
#include "flank/seed/orbit_chart.h"
#include "flank/seed/ruled_start.h"
#include "flank/seed/self_motion.h"

namespace flank {
using namespace internal;

namespace {

struct Candidate {
  const Chart* chart = nullptr;           // that the start is in
  const OrbitSection* section = nullptr;  // the chart is this one's
  RuledStart start;
  FitDraft draft;
  CoverageEstimate estimate = {};  // of a rough fit
  double score = -1.0;             // below that of any fit
};

/// The candidate's lines, moved along with the target and fitted to its section.
void orbit_fit(Candidate& candidate, FitDraft draft, const FlankFitOptions& options) {
  constexpr int kCoefficients = 12;  // of a free tool, as a polish has them
  const Target* target = draft.targets.front();
  const ObstacleField* obstacles = obstacles_of(draft, target);
  if (draft.free_tool) {
    const RadialJet tip = draft.tool.at(0.0);
    draft.tool = start_tool(draft.tool.axis_length(), tip.r, tip.d1, kCoefficients);
    draft.free_parameters.resize(kCoefficients);
    std::iota(draft.free_parameters.begin(), draft.free_parameters.end(), 0);
  }
  const ReachLimits reach = reach_of(options);
  const auto reachable = [&](const SurfaceSample& s) { return is_reachable(*target, obstacles, s, reach); };
  const OrbitStart start{target, obstacles, draft.motions, draft.tool, draft.free_parameters, reachable};
  OrbitFit fit = orbit_fit(*candidate.section, start, options);
  draft.motions = std::move(fit.motions);
  draft.tool = fit.tool;
  candidate.draft = std::move(draft);
  candidate.score = fit.score;
}

/// What is seen of a draft of any kind, a rough one among them, but for what it enters.
CoverageEstimate rough_estimate(const FitDraft& draft, const std::vector<SurfaceSample>& samples, double tolerance_mm,
                                int poses) {
  return estimate_coverage(samples, draft.motions, draft.tool, kQuickTolerances * tolerance_mm, poses);
}

double rough_score(const CoverageEstimate& estimate, double tolerance_mm) {
  return estimate.score(kQuickTolerances * tolerance_mm);
}

/// The score of what has its estimate, with what it enters.
void score_with_gouge(Candidate& candidate, const FlankFitOptions& options, int poses) {
  const FitDraft& draft = candidate.draft;
  candidate.estimate.gouge_mm =
      flank_gouge(draft.motions, draft.obstacles, draft.tool, options.bounds, poses, GougeLook::kRough);
  candidate.score = rough_score(candidate.estimate, options.tolerance_mm);
}

/// The score is what it is if the fit enters nothing.
void rough_fit(Candidate& candidate, const FitDraft& draft, const Target& target, const FlankFitOptions& options,
               const std::vector<SurfaceSample>& samples) {
  FitStage stage = quick_stage(robust_scale(target, options));
  set_motion_weights(stage, kQuickTolerances * options.tolerance_mm, target.diagonal());
  candidate.draft = run_stage(draft, options.bounds, stage);
  if (!has_values(candidate.draft)) return;
  candidate.estimate = rough_estimate(candidate.draft, samples, options.tolerance_mm, kQuickPoses);
  candidate.estimate.unheld = unheld_share(candidate.draft.motions, candidate.draft.tool, options);
  candidate.score = rough_score(candidate.estimate, options.tolerance_mm);
}

/// Fits and ranks one candidate. Left without motions if no line of its start is free, or if it loses its values.
void quick_fit(Candidate& candidate, const Target& target, const ToolModel& tool, const FlankFitOptions& options,
               const std::vector<SurfaceSample>& samples) {
  const LaidStart laid = lay_start(target, *candidate.chart, candidate.start, tool, options);
  if (laid.tasks.empty()) return;
  const FitDraft draft = start_draft(laid.tasks, tool, laid.start.radius_mm, std::sin(laid.start.lean_rad));
  if (candidate.section != nullptr)
    orbit_fit(candidate, draft, options);
  else
    rough_fit(candidate, draft, target, options, samples);
  if (!has_values(candidate.draft)) candidate.draft.motions.clear();  // a numerical no: one candidate less
}

/// Stable, so that equal scores keep the order of the starts on every machine.
void sort_by_score(std::vector<Candidate>& candidates) {
  std::stable_sort(candidates.begin(), candidates.end(),
                   [](const Candidate& a, const Candidate& b) { return a.score > b.score; });
}

/// Of candidates that are sorted by what they score if they enter nothing: looks for what they enter, the first ones first, and
/// keeps about the `most` best. A depth only lowers a score, and costs more than the fit: it is not asked of what cannot be
/// among them.
void rank_with_gouges(std::vector<Candidate>& candidates, std::size_t most, const FlankFitOptions& options) {
  std::vector<double> known;  // scores, falling
  while (known.size() < candidates.size()) {
    if (known.size() >= most && candidates[known.size()].score < known[most - 1]) break;
    const std::size_t first = known.size(), count = std::min(most, candidates.size() - first);
    parallel_for(count, [&](std::size_t k) { score_with_gouge(candidates[first + k], options, kQuickPoses); });
    for (std::size_t k = first; k < first + count; ++k) known.push_back(candidates[k].score);
    std::sort(known.begin(), known.end(), std::greater<>());
  }
  candidates.resize(known.size());
  sort_by_score(candidates);
}

/// What the quick fits of all starts leave.
struct QuickStarts {
  int tried = 0;
  bool touching = false;         ///< one of them touches the target
  std::vector<FitDraft> drafts;  ///< the best first, as many as are polished at most
};

/// The drafts without what tie() puts back.
void code(StepCodec& codec, QuickStarts& quick) {
  code(codec, quick.tried);
  code(codec, quick.touching);
  code(codec, quick.drafts);
}

/// Where starts are laid: the target's own chart, and, if a screw moves it along itself, that of its orbits. Prisms and turned
/// parts are done as well, and often with a better tool, from the lines of their own chart.
struct StartCharts {
  Chart own;
  std::optional<OrbitSection> section;
  std::optional<Chart> orbits;

  explicit StartCharts(const Target& target) : own(target) {
    constexpr double kSamples = 1600.0;  // of a smooth face, to know six numbers
    const auto motion = self_motion(target.samples(std::sqrt(target.area() / kSamples)));
    if (!motion || !motion->is_screw_at(own.at(0.5, 0.5).point)) return;
    section.emplace(target, own, *motion);
    orbits = orbit_chart(*section);
  }
};

/// Fits of orbits are as good as they get: no passes make up for what one is behind another.
void drop_hopeless(std::vector<Candidate>& sorted) {
  constexpr double kBehind = 0.02;  // of the section
  constexpr std::size_t kMost = 2;
  std::size_t kept = 0;
  while (kept < std::min(kMost, sorted.size()) && sorted[kept].score + kBehind >= sorted.front().score) ++kept;
  sorted.resize(kept);
}

/// Is this fit of orbits all that can be asked for? Else other motions may do more, or plunge less.
bool is_all(const Candidate& orbit, const FlankFitOptions& options) {
  constexpr double kNearlyAll = 0.97, kMostC = 0.9;
  return orbit.score >= kNearlyAll && touching_c(orbit.draft, options.tolerance_mm, kRankingPoses) < kMostC;
}

/// The candidates fitted; those that have a motion, the best first.
std::vector<Candidate> fitted(std::vector<Candidate> candidates, const Target& target, const ToolModel& tool,
                              const FlankFitOptions& options, const std::vector<SurfaceSample>& samples) {
  std::atomic<int> tried = 0;
  parallel_for(candidates.size(), [&](std::size_t k) {
    if (stopping() && tried > 0) return;  // one start is enough to have a result
    quick_fit(candidates[k], target, tool, options, samples);
    if (!candidates[k].draft.motions.empty()) ++tried;
  });
  std::erase_if(candidates, [](const Candidate& candidate) { return candidate.draft.motions.empty(); });
  sort_by_score(candidates);
  return candidates;
}

QuickStarts quick_starts(const Target& target, const ToolModel& tool, const FlankFitOptions& options) {
  QuickStarts quick;
  const StartCharts charts(target);
  FlankFitOptions coarse = options;
  coarse.sample_share = kQuickSampleShare;
  const std::vector<SurfaceSample> few = ranking_samples(target, options.obstacles, coarse);
  const auto best_in = [&](const Chart& chart, const OrbitSection* section, std::initializer_list<bool> ways) {
    std::vector<Candidate> candidates;
    for (const RuledStart& start : enumerate_starts(chart, tool, options, ways))
      candidates.push_back({.chart = &chart, .section = section, .start = start, .draft = {}});
    quick.tried += static_cast<int>(candidates.size());
    return fitted(std::move(candidates), target, tool, options, few);
  };
  std::vector<Candidate> best;
  if (charts.section && is_exact(*charts.section, options.tolerance_mm)) {
    best = best_in(*charts.orbits, &*charts.section, {false});
    drop_hopeless(best);
  }
  if (std::none_of(best.begin(), best.end(), [&](const Candidate& orbit) { return is_all(orbit, options); })) {
    for (Candidate& orbit : best) {
      orbit.estimate = rough_estimate(orbit.draft, few, options.tolerance_mm, kRankingPoses);
      score_with_gouge(orbit, options, kRankingPoses);
    }
    std::vector<Candidate> others = best_in(charts.own, nullptr, {false, true});
    rank_with_gouges(others, static_cast<std::size_t>(options.polished_candidates), options);
    for (Candidate& other : others) best.push_back(std::move(other));
    sort_by_score(best);
  }
  quick.touching = !best.empty() && best.front().score > 0.0;
  best.resize(std::min(best.size(), static_cast<std::size_t>(options.polished_candidates)));
  for (Candidate& candidate : best) quick.drafts.push_back(std::move(candidate.draft));
  return quick;
}

void look_closely(FitCandidate& runner, const std::vector<SurfaceSample>& samples, const FlankFitOptions& options,
                  const Progress& progress) {
  advance(runner, progress, "close check", [&](FitCandidate& next) { internal::look_closely(next, samples, options); });
}

/// From all starts to one result, with options.obstacles in the way from the beginning.
FlankFitResult search_starts(const Target& target, const ToolModel& tool, const FlankFitOptions& options,
                             const Progress& progress) {
  FlankFitResult result;
  progress.step("starts", 0.0);
  QuickStarts quick = journaled(progress, "starts", [&] { return quick_starts(target, tool, options); });
  for (FitDraft& draft : quick.drafts) reattach_targets(draft, target, options.obstacles);
  result.candidates = quick.tried;
  if (!quick.touching) {
    result.status = FitStatus::kNoStart;
    result.message = "no position of the tool to start from lies within four tolerances of the machined face";
  }
  if (quick.drafts.empty()) return result;
  progress.step("polish", 0.5);
  const std::vector<SurfaceSample> samples = ranking_samples(target, options.obstacles, options);
  FitCandidate best = run_finalists(quick.drafts, samples, options, progress);
  result.before = estimate_coverage(samples, best.start.motions, best.start.tool, options.tolerance_mm, kRankingPoses);
  result.trace = best.trace;
  result.rejected = best.beaten;
  result.closely_measured = best.enough || best.polished.estimate.at_tolerance >= options.least_coverage_for_close_look;
  if (!best.enough && result.closely_measured) look_closely(best, samples, options, progress);
  return make_result(best.polished, options, std::move(result));
}

/// The search with options.obstacles in the way, and the other ways where it does not give what was asked.
FlankFitResult search_lean_variants(const Target& target, const ToolModel& tool, const FlankFitOptions& options,
                                    const Progress& progress) {
  const auto search = [&](const FlankFitOptions& other) {
    Progress own = progress;
    if (other.obstacles != options.obstacles) own.found = nullptr;  // it may enter what it does not see
    return journaled(
        own, "search", [&] { return search_starts(target, tool, other, own); }, other, tool);
  };
  FlankFitResult first = search(options);
  if (options.obstacles == nullptr || !options.search_without_obstacles ||
      first.status == FitStatus::kWithinTolerance || progress.stop())
    return first;
  return best_way(target, tool, options, std::move(first), search, progress);
}

/// Samples that rank fits of all targets of the tasks, each once.
std::vector<SurfaceSample> ranking_samples_of(const std::vector<FitTask>& tasks, const FlankFitOptions& options) {
  std::vector<SurfaceSample> samples;
  std::vector<const Target*> seen;
  for (const FitTask& task : tasks) {
    if (std::find(seen.begin(), seen.end(), task.target) != seen.end()) continue;
    seen.push_back(task.target);
    const std::vector<SurfaceSample> own = ranking_samples(*task.target, task.obstacles, options);
    samples.insert(samples.end(), own.begin(), own.end());
  }
  return samples;
}

FlankFitResult polish_starts(const std::vector<FitTask>& tasks, const ToolModel& tool, const FlankFitOptions& options,
                             const Progress& progress) {
  FlankFitResult result;
  const std::vector<SurfaceSample> samples = ranking_samples_of(tasks, options);
  // The start is the user's: no quick fit, which would move it towards what ranks best, and no other candidates.
  FitDraft draft = make_draft(tasks, tool, options);
  progress.step("fit", 0.1);
  result.before = estimate_coverage(samples, draft.motions, draft.tool, options.tolerance_mm, kRankingPoses);
  FitCandidate only{.start = draft, .polished = {draft, {}, false}, .trace = {}, .beaten = {}};
  advance(only, progress, "polish", [&](FitCandidate& next) {
    next.polished = polish(draft, samples, options, &next.trace);
    settle_if_enough(next, samples, options);
  });
  progress.step("fit", 0.5);
  if (!only.enough) {
    advance(only, progress, "fine fit",
            [&](FitCandidate& next) { next.polished = last_passes(next.polished, samples, options, &next.trace); });
    look_closely(only, samples, options, progress);
  }
  progress.step("fit", 0.9);
  result.trace = std::move(only.trace);
  return make_result(only.polished, options, std::move(result));
}

}  // namespace

FlankFitResult fit_automatic(const Target& target, const ToolModel& tool, const FlankFitOptions& options,
                             const Progress& progress) {
  return journaled(
      progress, "fit", [&] { return search_lean_variants(target, tool, options, progress); }, options, tool);
}

FlankFitResult fit_from_starts(const std::vector<FitTask>& tasks, const ToolModel& tool, const FlankFitOptions& options,
                               const Progress& progress) {
  std::vector<RuledMotion> starts;
  for (const FitTask& task : tasks) starts.push_back(task.motion);
  const auto work = [&] { return polish_starts(tasks, tool, options, progress); };
  return journaled(progress, "fit from starts", work, options, tool, starts);
}

FlankFitResult fit_as_found(const std::vector<FitTask>& tasks, const RadialFunction& found, const ToolModel& tool,
                            const FlankFitOptions& options) {
  FLANK_ASSERT(!tasks.empty());
  FitDraft draft = make_draft(tasks, tool, options);
  draft.tool = found;
  return make_result(measured_closely(draft, options), options, {});
}

FlankFitResult fit_together(const std::vector<FitTask>& tasks, const RadialFunction& found, const ToolModel& tool,
                            const FlankFitOptions& options, const Progress& progress) {
  FlankFitResult as_found = fit_as_found(tasks, found, tool, options);
  if (meets(as_found.after, options.enough_coverage, options) || progress.stop()) return as_found;
  FlankFitResult polished = fit_from_starts(tasks, tool, options, progress);
  return is_better(as_found.after, polished.after, options) ? as_found : polished;
}

FlankFitResult with_close_look(const std::vector<FitTask>& tasks, const FlankFitResult& found, const ToolModel& tool,
                               const FlankFitOptions& options) {
  FLANK_ASSERT(!tasks.empty() && tasks.size() == found.motions.size());
  const std::vector<SurfaceSample> samples = ranking_samples_of(tasks, options);
  FitDraft draft = make_draft(tasks, tool, options);
  draft.motions = found.motions;
  draft.tool = found.tool;
  const Polished polished = assess(std::move(draft), samples, options);
  FlankFitResult result = make_result(measured_closely(polished, samples, options), options, found);
  result.closely_measured = true;
  return result;
}

std::optional<FlankFitResult> mend_fit(const std::vector<FitTask>& tasks, const FlankFitResult& found,
                                       const ToolModel& tool, const FlankFitOptions& options) {
  FLANK_ASSERT(tasks.size() == found.motions.size());
  if (tasks.empty() || stopping()) return std::nullopt;
  FitDraft draft = make_draft(tasks, tool, options);
  draft.motions = found.motions;
  draft.tool = found.tool;
  const Polished before = measured_closely(draft, options);
  const Polished after = repair_closely(before, options);
  if (!is_better(after.estimate, before.estimate, options)) return std::nullopt;
  return make_result(after, options, found);
}

}  // namespace flank
