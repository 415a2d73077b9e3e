#include "flank/fit/polish.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "flank/base/parallel.h"
#include "flank/base/stopping.h"
#include "flank/base/tolerance_budget.h"
#include "flank/fit/coverage.h"
#include "flank/fit/partial_polish.h"
#include "flank/fit/rank.h"
#include "flank/fit/swept_polish.h"
#include "flank/tool.h"
#include "flank/tool/smooth_tool.h"

namespace flank::internal {
namespace {

/// A residual (root mean square) below this share of the diagonal says that the target is an envelope of such a tool:
/// go for the last digits. Above what the polish pass's weights can leave on an exact envelope (1e-6 of the size by
/// fairness, 3e-3 of a slide of a few thousandths by the pin: polish_stage); on a face of 100 mm it is 2e-3 mm.
constexpr double kExactShare = 2e-5;
/// Of a free tool's first spline, as the quick pass has: an average over the motion shows no finer profile.
constexpr int kFirstCoefficients = 6;

/// Distances of the axes' points to their targets, averaged over time: the first radial function. Cold footpoints at
/// kS x kT places: four for each coefficient along the axis; over time an average does not need many.
RadialFunction mean_distance_tool(const std::vector<FitTask>& tasks, const RadiusBounds& bounds) {
  constexpr int kS = 25, kT = 15;
  const double length = tasks.front().motion.axis_length;
  std::vector<Vec2> samples;
  for (int j = 0; j < kS; ++j) {
    const double s = length * j / (kS - 1);
    double sum = 0.0;
    int count = 0;
    for (const FitTask& task : tasks) {
      for (int i = 0; i < kT; ++i) {
        const Footpoint foot = task.target->closest(task.motion.pose((i + 0.5) / kT).at(s));
        sum += foot.distance;
        ++count;
      }
    }
    samples.emplace_back(s, std::clamp(sum / count, bounds.smallest, bounds.largest));
  }
  return RadialFunction::spline_through(length, samples, kFirstCoefficients);
}

/// The tasks of a draft; its tool is still to come.
FitDraft without_tool(const std::vector<FitTask>& tasks, const ToolModel& tool) {
  FitDraft draft;
  for (const FitTask& task : tasks) {
    draft.targets.push_back(task.target);
    draft.motions.push_back(task.motion);
    draft.obstacles.push_back(task.obstacles);
  }
  draft.free_tool = tool.free();
  return draft;
}

/// Largest residual against the target itself, between the samples of the passes: 96 intervals share no place with the
/// 119 and 179 of the exact passes but the ends.
double validated_error(const FitDraft& draft) {
  constexpr int kT = 97, kS = 29;
  std::vector<FitTask> tasks;
  for (std::size_t m = 0; m < draft.motions.size(); ++m) tasks.push_back({draft.targets[m], draft.motions[m]});
  return validate(tasks, draft.tool, kT, kS).largest_mm;
}

/// For targets that are envelopes: passes of growing resolution, the one kept whose error off the samples is least.
Polished exact_polish(const Polished& start, const std::vector<SurfaceSample>& samples, const FlankFitOptions& options,
                      std::vector<IterationTrace>* trace) {
  Polished best = start;
  double least = validated_error(start.draft);
  FitDraft draft = start.draft;
  // The last stage twice: its pins hold to its own start, which the first of the two has moved.
  for (bool last : {false, true, true}) {
    if (stopping()) break;
    draft = run_stage(draft, options.bounds, exact_stage(last), trace);
    const double error = validated_error(draft);
    Polished trial = assess(draft, samples, options);
    const bool covers = trial.estimate.at_tolerance > best.estimate.at_tolerance - kSameCoverage;
    if (!covers || error > least) continue;
    least = error;
    best = std::move(trial);
  }
  return best;
}

/// How a draft is measured: assess(), or a closer look.
using Look = Polished (*)(FitDraft draft, const std::vector<SurfaceSample>& samples, const FlankFitOptions& options);

/// The polished draft with all radii of its free spline smaller by a length (not below the bound): r(s) - by, exactly.
/// `look`: that which the polished draft was measured by.
Polished with_radii_reduced(const Polished& polished, double by, const std::vector<SurfaceSample>& samples,
                            const FlankFitOptions& options, Look look = assess) {
  FitDraft draft = polished.draft;
  const Eigen::VectorXd radii = draft.tool.parameters().array() - by;
  draft.tool = draft.tool.with_parameters(radii.cwiseMax(options.bounds.smallest));
  if (radii.minCoeff() < options.bounds.smallest) return look(std::move(draft), samples, options);
  // Every ball is smaller by that length, and enters obstacles less deep by it: nothing to measure again.
  const std::vector<const ObstacleField*> obstacles = std::exchange(draft.obstacles, {});
  Polished shifted = assess(std::move(draft), samples, options);
  shifted.draft.obstacles = obstacles;
  shifted.estimate.gouge_mm = std::max(0.0, polished.estimate.gouge_mm - by);
  return shifted;
}

/// A free tool's radii reduced against overcut, as far as that scores better: every length less on the radius is one
/// less of overcut and one more of material left.
Polished reduce_overcut(const Polished& polished, const std::vector<SurfaceSample>& samples,
                        const FlankFitOptions& options, Look look = assess) {
  if (!polished.draft.free_tool) return polished;
  Polished best = polished;
  // Just enough to be within the tolerance, with room for what lies between the samples; and quarters of all, because
  // the score has steps (samples that leave the tolerance) and no derivative to follow.
  const double overcut = polished.estimate.overcut_mm,
               excess = overcut - kToleranceBudget.fit.overcut * options.tolerance_mm;
  for (double by : {excess, 0.25 * overcut, 0.5 * overcut, 0.75 * overcut, overcut}) {
    if (by <= 0.0) continue;
    Polished trial = with_radii_reduced(polished, by, samples, options, look);
    if (trial.estimate.score(options.tolerance_mm) > best.estimate.score(options.tolerance_mm)) best = std::move(trial);
  }
  return best;
}

/// A free, exact fit with more overcut than it may have: its radii are reduced until it has that; its motion, and so its
/// last digits, stay. Not where it would cost coverage: then the residuals at the axis hide a deep cut elsewhere.
Polished reduce_exact_overcut(const Polished& exact, const std::vector<SurfaceSample>& samples,
                              const FlankFitOptions& options) {
  const double by = exact.estimate.overcut_mm - exact_overcut(exact.draft, options.tolerance_mm);
  if (!exact.draft.free_tool || by <= 0.0 || by > options.tolerance_mm) return exact;
  Polished lower = with_radii_reduced(exact, by, samples, options);
  lower.exact = true;
  return lower.estimate.at_tolerance > exact.estimate.at_tolerance - kSameCoverage ? lower : exact;
}

}  // namespace

FitDraft make_draft(const std::vector<FitTask>& tasks, const ToolModel& tool, const FlankFitOptions& options) {
  FitDraft draft = without_tool(tasks, tool);
  draft.tool = draft.free_tool && tool.first ? *tool.first : mean_distance_tool(tasks, options.bounds);
  if (draft.free_tool) return draft;
  const double length = tasks.front().motion.axis_length;
  draft.tool = tool.make(length, draft.tool.at(0.5 * length).r);
  draft.free_parameters = tool.free_parameters;
  return draft;
}

RadialFunction start_tool(double axis_length, double radius, double slope, int coefficients) {
  if (slope == 0.0) return RadialFunction::spline(axis_length, Eigen::VectorXd::Constant(coefficients, radius));
  std::vector<Vec2> samples;
  for (int k = 0; k <= 4 * coefficients; ++k) {
    const double s = axis_length * k / (4.0 * coefficients);
    samples.emplace_back(s, radius + slope * s);
  }
  return RadialFunction::spline_through(axis_length, samples, coefficients);
}

FitDraft start_draft(const std::vector<FitTask>& tasks, const ToolModel& tool, double radius, double slope) {
  FitDraft draft = without_tool(tasks, tool);
  const double length = tasks.front().motion.axis_length;
  draft.free_parameters = tool.free_parameters;
  draft.tool = tool.free() ? start_tool(length, radius, slope, kFirstCoefficients) : tool.make(length, radius);
  return draft;
}

Polished polish(const FitDraft& draft, const std::vector<SurfaceSample>& samples, const FlankFitOptions& options,
                std::vector<IterationTrace>* trace) {
  ResidualSummary summary;  // of the first pass, which decides between the two ways
  Polished best = assess(draft, samples, options);
  const auto keep = [&](Polished&& trial) {
    if (trial.estimate.score(options.tolerance_mm) > best.estimate.score(options.tolerance_mm)) best = std::move(trial);
  };
  if (stopping()) return best;
  const double diagonal = draft.targets.front()->diagonal();
  const double scale = robust_scale(*draft.targets.front(), options);
  FitStage first = polish_stage(scale);
  set_motion_weights(first, options.tolerance_mm, diagonal);
  first.parallel_weight = 0.0;  // this pass shows whether the target is an envelope, whose axes lean as they do
  keep(assess(run_stage(draft, options.bounds, first, trace, &summary), samples, options));
  if (summary.rms_mm < kExactShare * diagonal) {
    best = exact_polish(best, samples, options, trace);
    best.exact = true;
    // An exact motion that plunges where it touches is worth less than one within the tolerance that does not.
    if (best.estimate.largest_c < 1.0) return reduce_exact_overcut(best, samples, options);
  }
  if (stopping()) return best;
  const FitStage stage = tolerance_stage(options.tolerance_mm, scale, diagonal);
  if (draft.free_tool || !draft.free_parameters.empty())
    keep(assess(run_stage(best.draft, options.bounds, stage, trace), samples, options));
  return reduce_overcut(best, samples, options);
}

Polished last_passes(const Polished& polished, const std::vector<SurfaceSample>& samples,
                     const FlankFitOptions& options, std::vector<IterationTrace>* trace, const IsEnough& enough,
                     bool begun) {
  if (stopping()) return polished;
  // An exact fit has its residuals at the axis; some of the face may lie past the axis' end: the passes below see it.
  const bool short_of_face = polished.estimate.at_tolerance < options.enough_coverage;
  // Residuals at the axis can be exact while the tool cuts deep elsewhere.
  const bool deep = polished.draft.free_tool && polished.estimate.overcut_mm > options.tolerance_mm;
  if (polished.exact && !short_of_face && !deep) return reduce_exact_overcut(polished, samples, options);
  return reduce_overcut(swept_polish(polished, samples, options, trace, enough, begun), samples, options);
}

namespace {

/// The samples of the last look: of the targets, 16 times as many as rank drafts.
std::vector<SurfaceSample> close_samples(const FitDraft& draft, const FlankFitOptions& options) {
  constexpr double kDenser = 4.0;  // in each direction
  FlankFitOptions dense = options;
  dense.sample_share = options.sample_share / kDenser;
  std::vector<SurfaceSample> samples;
  for (const Target* target : distinct_targets(draft)) {
    const std::vector<SurfaceSample> more = ranking_samples(*target, obstacles_of(draft, target), dense);
    samples.insert(samples.end(), more.begin(), more.end());
    // The rim once more as dense: a tool that runs past it is deepest there, in a narrow place.
    const double spacing = std::sqrt(target->area()) * dense.sample_share / kDenser;
    for (const Vec3& point : target->border_points(spacing)) samples.push_back({point, Vec3::UnitZ()});
  }
  return samples;
}

Polished seen_closely(FitDraft draft, const std::vector<SurfaceSample>& samples, const FlankFitOptions& options) {
  Polished seen = assess(std::move(draft), samples, options);
  /// Times as many poses: a path that runs past an edge is deepest there for a moment.
  constexpr int kOften = 4;
  seen.estimate.gouge_mm = flank_gouge(seen.draft.motions, seen.draft.obstacles, seen.draft.tool, options.bounds,
                                       kOften * kRankingPoses, GougeLook::kClose);
  if (has_values(seen.draft)) measure_written(seen.draft, options, seen.estimate);
  seen.estimate.legitimate = !seen.draft.free_tool || check_legitimacy(seen.draft.tool).legitimate;
  return seen;
}

/// A fit that the last look finds a little deeper than allowed, led out of what it cuts. `steadiness`: as pass_at has it.
Polished repair_cuts(const Polished& polished, const std::vector<SurfaceSample>& samples,
                     const FlankFitOptions& options, double steadiness = 1.0) {
  constexpr int kMost = 3;          // times: each brings places that the one before has made deep
  constexpr double kFirmer = 10.0;  // each time: what a soft term leaves goes with its weight
  const double tolerance = options.tolerance_mm;
  Polished best = polished;
  double firmness = 1.0;
  for (int k = 0; k < kMost && !is_clean(best.estimate, tolerance) && !stopping(); ++k) {
    if (std::max(best.estimate.overcut_mm, best.estimate.gouge_mm) > kMendable * tolerance) return best;
    const std::vector<Vec3> deep = cut_deeper_than(kToleranceBudget.fit.settled_overcut * tolerance, samples,
                                                   best.draft.motions, best.draft.tool, kRankingPoses);
    if (best.estimate.gouge_mm > kToleranceBudget.fit.clean * tolerance) firmness *= kFirmer;
    Polished trial = seen_closely(pass_at(best.draft, deep, options, firmness, best.estimate.at_tolerance, steadiness),
                                  samples, options);
    if (!is_better(trial.estimate, best.estimate, options)) return best;
    best = std::move(trial);
  }
  return best;
}

/// What steadying cost of coverage, regained as far as a few more passes do without plunging again.
Polished recover_coverage(Polished steady, double covered, double steadiness, const std::vector<SurfaceSample>& samples,
                          const FlankFitOptions& options) {
  constexpr int kMost = 3;
  for (int k = 0; k < kMost && steady.estimate.at_tolerance < covered && !stopping(); ++k) {
    const FitDraft draft = pass_at(steady.draft, {}, options, 1.0, steady.estimate.at_tolerance, steadiness);
    Polished more = repair_cuts(seen_closely(draft, samples, options), samples, options, steadiness);
    if (!is_better(more.estimate, steady.estimate, options)) break;
    steady = std::move(more);
  }
  return steady;
}

/// A fit that plunges where it touches, or has a kink, led into a motion that does neither, where that costs no more than those do:
/// earlier passes may leave a cusp of a rail that the face does not require.
Polished remove_plunge(const Polished& polished, const std::vector<SurfaceSample>& samples,
                       const FlankFitOptions& options) {
  /// As much as it takes, where the face holds against it.
  constexpr std::array kFirmness = {10.0, 100.0, 1000.0};
  if (is_steady(polished.estimate)) return polished;
  for (const double firmness : kFirmness) {
    if (stopping()) break;
    Polished trial = seen_closely(steady_pass(polished.draft, options, firmness), samples, options);
    // Led out of what it cuts with the weights of other passes, it would plunge again.
    trial = repair_cuts(trial, samples, options, firmness);
    if (is_steady(trial.estimate) && is_better(trial.estimate, polished.estimate, options))
      return recover_coverage(std::move(trial), polished.estimate.at_tolerance, firmness, samples, options);
  }
  return polished;
}

/// A free tool that is none somewhere between the samples of the passes (its spheres are not inscribed there), made one: by
/// smoothing it there, or by another pass if that is better. As it was if that costs more than half of what is covered.
Polished make_tool_legitimate(const Polished& polished, const std::vector<SurfaceSample>& samples,
                              const FlankFitOptions& options) {
  if (!polished.draft.free_tool || polished.estimate.legitimate) return polished;
  Polished best = polished;
  const auto smooth = [&](FitDraft draft) {
    const auto tool = smoothed_to_tool(draft.tool, options.tolerance_mm);
    if (tool) draft.tool = *tool;
    Polished trial = seen_closely(std::move(draft), samples, options);
    if (is_better(trial.estimate, best.estimate, options)) best = std::move(trial);
  };
  smooth(polished.draft);
  const bool costs = best.estimate.at_tolerance < polished.estimate.at_tolerance - kSameCoverage;
  if ((costs || !is_clean(best.estimate, options.tolerance_mm)) && !stopping())
    smooth(pass_at(polished.draft, {}, options, 1.0, polished.estimate.at_tolerance));
  return best;
}

}  // namespace

Polished repair_closely(const Polished& polished, const FlankFitOptions& options) {
  if (stopping()) return polished;
  const std::vector<SurfaceSample> samples = close_samples(polished.draft, options);
  Polished again = make_tool_legitimate(seen_closely(polished.draft, samples, options), samples, options);
  again = remove_plunge(repair_cuts(again, samples, options), samples, options);
  const bool legitimate = again.estimate.legitimate;
  if (again.estimate.overcut_mm > options.tolerance_mm) again = reduce_overcut(again, samples, options, seen_closely);
  again.estimate.legitimate = legitimate;  // smaller radii make no sphere stick out of the others
  // Between these samples, too, nothing may be cut deeper than the tolerance: a little room, if it costs little of the
  // covered share.
  constexpr double kCost = 0.005;
  constexpr double kDeepest = kToleranceBudget.others.fit_allowance + kToleranceBudget.others.soft_term;
  const double by = std::max(again.estimate.overcut_mm - kToleranceBudget.fit.settled_overcut * options.tolerance_mm,
                             again.estimate.gouge_mm - kDeepest * options.tolerance_mm);
  if (!again.draft.free_tool || by <= 0.0) return again;
  Polished lower = with_radii_reduced(again, by, samples, options, seen_closely);
  lower.estimate.legitimate = legitimate;
  const bool cheap = lower.estimate.at_tolerance >= again.estimate.at_tolerance - kCost;
  // What is deeper than allowed may cost more: a clean result is worth it, unless little is left.
  return cheap || is_better(lower.estimate, again.estimate, options) ? lower : again;
}

Polished measured_closely(const FitDraft& draft, const FlankFitOptions& options) {
  return seen_closely(draft, close_samples(draft, options), options);
}

FlankFitResult make_result(const Polished& polished, const FlankFitOptions& options, FlankFitResult result) {
  result.tool = polished.draft.tool;
  result.motions = polished.draft.motions;
  result.after = polished.estimate;
  std::vector<FitTask> tasks;
  for (std::size_t m = 0; m < result.motions.size(); ++m)
    tasks.push_back({polished.draft.targets[m], result.motions[m]});
  // A grid of its own: 59 and 23 are primes, so it has nothing in common with the passes' grids but the ends.
  constexpr int kT = 60, kS = 24;
  result.residuals = validate(tasks, result.tool, kT, kS);
  const bool good = meets(result.after, options.least_coverage, options);
  result.status = good ? FitStatus::kWithinTolerance : FitStatus::kPartial;
  result.message = fmt::format("estimate: {:.2f} % finished at {:.4g} mm, gouge {:.4g} mm",
                               100.0 * result.after.at_tolerance, options.tolerance_mm, result.after.overcut_mm);
  return result;
}

}  // namespace flank::internal
