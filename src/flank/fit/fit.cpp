#include "flank/fit.h"
#include "flank/base/stopping.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

#include "flank/base/assert.h"
#include "flank/base/journal.h"
#include "flank/base/parallel.h"
#include "flank/fit/coverage.h"
#include "flank/fit/fit_record.h"
#include "flank/fit/orbit/orbit_fit.h"
#include "flank/fit/polish.h"
#include "flank/fit/race.h"
#include "flank/fit/tried.h"
#include "flank/fit/ways.h"
#include "flank/motion/motion_record.h"
#include "flank/seed/clear_start.h"
#include "flank/seed/orbit_chart.h"
#include "flank/seed/ruled_start.h"
#include "flank/seed/self_motion.h"

namespace flank {
using namespace internal;

namespace {

/// Control points of a start's rails. The quick fit brings them to its own 8 at once; these only carry the start there.
constexpr int kStartControlPoints = 12;

struct Candidate {
  const Chart* chart = nullptr;           // that the start is in
  const OrbitSection* section = nullptr;  // the chart is this one's
  RuledStart start;
  FitDraft draft;
  double score = -1.0;  // below that of any fit
};

/// Radii to try, equally spaced in logarithm in the middles of kRadii parts of the range: what differs between a thin
/// tool and a thick one is the ratio.
std::vector<double> start_radii(const ToolModel& tool, const RadiusBounds& bounds, double length) {
  if (tool.radius) return {*tool.radius};
  constexpr int kRadii = 5;             // MATH section 7
  constexpr double kLeastRatio = 1e-3;  // of the largest: a lower bound of zero has no logarithm
  std::vector<double> radii;
  // A cylinder that is too slender is no start for a tool that may not be.
  constexpr double kMostRatio = 0.8;
  const double stiff = std::min(0.5 * length / bounds.slenderest, kMostRatio * bounds.largest);
  const double low = std::max({bounds.smallest, kLeastRatio * bounds.largest, tool.free() ? stiff : 0.0});
  for (int k = 0; k < kRadii; ++k) radii.push_back(low * std::pow(bounds.largest / low, (k + 0.5) / kRadii));
  return radii;
}

std::vector<RuledStart> enumerate_starts(const Chart& chart, const ToolModel& tool, const FlankFitOptions& options,
                                         std::initializer_list<bool> ways) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  // Degrees between contact lines and the chart's lines. Five (MATH section 7), of either sign, because nothing tells
  // which way a blade twists. No start is farther than 6.5 degrees from a direction up to 31 degrees; the fit turns the
  // rest.
  constexpr std::array<double, 5> kSkews = {0.0, 12.0, -12.0, 25.0, -25.0};
  std::vector<RuledStart> starts;
  for (bool swapped : ways) {
    RuledStart across;
    across.swapped = swapped;
    const double length = options.axis_length_mm.value_or(longest_chord(chart, across));
    for (double radius : start_radii(tool, options.bounds, length))
      for (double skew : kSkews) {
        RuledStart start;
        start.swapped = swapped;
        start.radius_mm = radius;
        start.skew_rad = skew * kDegree;
        starts.push_back(start);
      }
  }
  return starts;
}

/// The start cut into bands of equal width side by side, one per strip.
std::vector<RuledStart> bands_of(const RuledStart& start, int strips) {
  std::vector<RuledStart> bands(static_cast<std::size_t>(strips), start);
  for (int k = 0; k < strips; ++k) {
    bands[static_cast<std::size_t>(k)].band_low = static_cast<double>(k) / strips;
    bands[static_cast<std::size_t>(k)].band_high = static_cast<double>(k + 1) / strips;
  }
  return bands;
}

/// The motions of a start beside walls: the tips on the spine of the ball that rolls along target and wall. None if no
/// wall is in the way of the lines.
std::vector<FitTask> make_clear_tasks(const Target& target, const Chart& chart, const RuledStart& start,
                                      const ToolModel& tool, const FlankFitOptions& options) {
  const ObstacleField& obstacles = *options.obstacles;
  constexpr int kFewBlocked = kStartTimes / 4;  // if a wall only grazes the lines, the fit does better than a cut
  constexpr double kLonger = 1.03;              // the axis past the longest stretch from spine to rim (MATH section 7)
  std::vector<ClearStart> bands;
  double length = 0.0;
  bool blocked = false;
  for (const RuledStart& band : bands_of(start, options.strips)) {
    ClearStart clear = clear_start(chart, band, obstacles);
    length = std::max(length, kLonger * clear.longest_mm);
    const bool cut = clear.first > 0.0 || clear.last < 1.0;
    blocked = blocked || cut || clear.blocked_lines > kFewBlocked || clear.free_lines < kStartTimes - kFewBlocked;
    if (clear.free_lines > 0) bands.push_back(std::move(clear));
  }
  if (!blocked) return {};
  length = tool.length_for(length, options.axis_length_mm);
  std::vector<FitTask> tasks;
  for (const ClearStart& band : bands)
    tasks.push_back({&target, make_motion(band, length, kStartControlPoints), &obstacles});
  return tasks;
}

/// The motions of a start, one per strip, bands side by side, all of one axis length.
std::vector<FitTask> make_tasks(const Target& target, const Chart& chart, const RuledStart& start,
                                const ToolModel& tool, const FlankFitOptions& options) {
  if (options.obstacles != nullptr) {
    std::vector<FitTask> tasks = make_clear_tasks(target, chart, start, tool, options);
    if (!tasks.empty()) return tasks;
  }
  const std::vector<RuledStart> bands = bands_of(start, options.strips);
  constexpr double kLonger = 1.02;  // the axis past the longest offset contact line (MATH section 7)
  double length = 0.0;
  for (const RuledStart& band : bands) length = std::max(length, kLonger * longest_chord(chart, band));
  length = tool.length_for(length, options.axis_length_mm);
  std::vector<FitTask> tasks;
  for (const RuledStart& band : bands)
    tasks.push_back({&target, make_motion(chart, band, length, kStartControlPoints), options.obstacles});
  return tasks;
}

/// The candidate's lines, moved along with the target and fitted to its section.
void orbit_fit(Candidate& candidate, FitDraft draft, const FlankFitOptions& options) {
  constexpr int kCoefficients = 12;  // of a free tool, as a polish has them
  const Target* target = draft.targets.front();
  const ObstacleField* obstacles = obstacles_of(draft, target);
  if (draft.free_tool) {
    const double r = draft.tool.at(0.5 * draft.tool.axis_length()).r;
    draft.tool = RadialFunction::spline(draft.tool.axis_length(), Eigen::VectorXd::Constant(kCoefficients, r));
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

/// What drafts of any kind are ranked by, those that are rough among them.
double rough_score(const FitDraft& draft, const std::vector<SurfaceSample>& samples, double tolerance_mm, int poses) {
  CoverageEstimate estimate =
      estimate_coverage(samples, draft.motions, draft.tool, kQuickTolerances * tolerance_mm, poses);
  estimate.gouge_mm = flank_gouge(draft.motions, draft.obstacles, draft.tool, poses, GougeLook::kRough);
  return estimate.score(kQuickTolerances * tolerance_mm);
}

void rough_fit(Candidate& candidate, const FitDraft& draft, const Target& target, const FlankFitOptions& options,
               const std::vector<SurfaceSample>& samples) {
  FitStage stage = quick_stage(robust_scale(target, options));
  keep_going(stage, kQuickTolerances * options.tolerance_mm, target.diagonal());
  candidate.draft = run_stage(draft, options.bounds, stage);
  if (has_values(candidate.draft))
    candidate.score = rough_score(candidate.draft, samples, options.tolerance_mm, kQuickPoses);
}

/// Fits and ranks one candidate. Left without motions if no line of its start is free, or if it loses its values.
void quick_fit(Candidate& candidate, const Target& target, const ToolModel& tool, const FlankFitOptions& options,
               const std::vector<SurfaceSample>& samples) {
  const std::vector<FitTask> tasks = make_tasks(target, *candidate.chart, candidate.start, tool, options);
  if (tasks.empty()) return;
  const FitDraft draft = start_draft(tasks, tool, candidate.start.radius_mm);
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
      candidates.push_back({&chart, section, start, {}, -1.0});
    quick.tried += static_cast<int>(candidates.size());
    return fitted(std::move(candidates), target, tool, options, few);
  };
  std::vector<Candidate> best;
  if (charts.section && is_exact(*charts.section, options.tolerance_mm)) {
    best = best_in(*charts.orbits, &*charts.section, {false});
    drop_hopeless(best);
  }
  if (std::none_of(best.begin(), best.end(), [&](const Candidate& orbit) { return is_all(orbit, options); })) {
    for (Candidate& orbit : best) orbit.score = rough_score(orbit.draft, few, options.tolerance_mm, kRankingPoses);
    for (Candidate& other : best_in(charts.own, nullptr, {false, true})) best.push_back(std::move(other));
    sort_by_score(best);
  }
  quick.touching = !best.empty() && best.front().score > 0.0;
  best.resize(std::min(best.size(), static_cast<std::size_t>(options.kept_after_quick)));
  for (Candidate& candidate : best) quick.drafts.push_back(std::move(candidate.draft));
  return quick;
}

void look_closely(Runner& runner, const std::vector<SurfaceSample>& samples, const FlankFitOptions& options,
                  const Progress& progress) {
  advance(runner, progress, "close look",
          [&](Runner& next) { next.polished = looked_at_closely(next.polished, samples, options); });
}

/// From all starts to one result, with options.obstacles in the way from the beginning.
FlankFitResult search_starts(const Target& target, const ToolModel& tool, const FlankFitOptions& options,
                             const Progress& progress) {
  FlankFitResult result;
  progress.step("starts", 0.0);
  QuickStarts quick = journaled(progress, "starts", [&] { return quick_starts(target, tool, options); });
  for (FitDraft& draft : quick.drafts) tie(draft, target, options.obstacles);
  result.candidates = quick.tried;
  if (!quick.touching) {
    result.status = FitStatus::kNoStart;
    result.message = "no ruled start touches the target within four tolerances";
  }
  if (quick.drafts.empty()) return result;
  progress.step("polish", 0.5);
  const std::vector<SurfaceSample> samples = ranking_samples(target, options.obstacles, options);
  Runner best = race(quick.drafts, samples, options, progress);
  result.before = estimate_coverage(samples, best.start.motions, best.start.tool, options.tolerance_mm, kRankingPoses);
  result.trace = best.trace;
  result.tried = best.beaten;
  if (!best.enough) look_closely(best, samples, options, progress);
  return finish(best.polished, options, std::move(result));
}

/// The search with options.obstacles in the way, and the other ways where it does not give what was asked.
FlankFitResult search_ways(const Target& target, const ToolModel& tool, const FlankFitOptions& options,
                           const Progress& progress) {
  const auto search = [&](const FlankFitOptions& other) {
    Progress own = progress;
    if (other.obstacles != options.obstacles) own.found = nullptr;  // it may enter what it does not see
    return journaled(
        own, "search", [&] { return search_starts(target, tool, other, own); }, other, tool);
  };
  FlankFitResult first = search(options);
  if (options.obstacles == nullptr || !options.ways || first.status == FitStatus::kWithinTolerance || progress.stop())
    return first;
  return best_way(target, tool, options, std::move(first), search, progress);
}

FlankFitResult polish_starts(const std::vector<FitTask>& tasks, const ToolModel& tool, const FlankFitOptions& options,
                             const Progress& progress) {
  FlankFitResult result;
  const std::vector<SurfaceSample> samples = ranking_samples(*tasks.front().target, tasks.front().obstacles, options);
  // The start is the user's: no quick fit, which would move it towards what ranks best, and no other candidates.
  FitDraft draft = make_draft(tasks, tool, options);
  progress.step("fit", 0.1);
  result.before = estimate_coverage(samples, draft.motions, draft.tool, options.tolerance_mm, kRankingPoses);
  Runner only{.start = draft, .polished = {draft, {}, false}, .trace = {}, .beaten = {}};
  advance(only, progress, "polish", [&](Runner& next) {
    next.polished = polish(draft, samples, options, &next.trace);
    settle_if_enough(next, samples, options);
  });
  progress.step("fit", 0.5);
  if (!only.enough) {
    advance(only, progress, "last passes",
            [&](Runner& next) { next.polished = last_passes(next.polished, samples, options, &next.trace); });
    look_closely(only, samples, options, progress);
  }
  progress.step("fit", 0.9);
  result.trace = std::move(only.trace);
  return finish(only.polished, options, std::move(result));
}

}  // namespace

FlankFitResult fit_automatic(const Target& target, const ToolModel& tool, const FlankFitOptions& options,
                             const Progress& progress) {
  return journaled(
      progress, "fit", [&] { return search_ways(target, tool, options, progress); }, options, tool);
}

FlankFitResult fit_from_starts(const std::vector<FitTask>& tasks, const ToolModel& tool, const FlankFitOptions& options,
                               const Progress& progress) {
  std::vector<RuledMotion> starts;
  for (const FitTask& task : tasks) starts.push_back(task.motion);
  const auto work = [&] { return polish_starts(tasks, tool, options, progress); };
  return journaled(progress, "fit from starts", work, options, tool, starts);
}

std::optional<FlankFitResult> mend_fit(const std::vector<FitTask>& tasks, const FlankFitResult& found,
                                       const ToolModel& tool, const FlankFitOptions& options) {
  FLANK_ASSERT(tasks.size() == found.motions.size());
  if (tasks.empty() || stopping()) return std::nullopt;
  FitDraft draft = make_draft(tasks, tool, options);
  draft.motions = found.motions;
  draft.tool = found.tool;
  const Polished before = looked_at_closely(draft, options);
  const Polished after = settled(before, options);
  if (!is_better(after.estimate, before.estimate, options.tolerance_mm)) return std::nullopt;
  return finish(after, options, found);
}

}  // namespace flank
