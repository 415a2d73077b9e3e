#include "flank/fit/swept_polish.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "flank/base/parallel.h"
#include "flank/fit/model/constrained.h"
#include "flank/fit/model/levenberg_marquardt.h"

namespace flank::internal {
namespace {

/// Passes in turn: dead zone in tolerances, fairness, anchor, control points, coefficients; points a side of the target
/// (the judge's samples are several times denser).
struct Pass {
  double dead_zone, fairness, anchor;
  int control_points, coefficients, iterations, points_per_side;
};
constexpr double kFair = 1e-3, kSoft = 1e-6;
constexpr std::array<Pass, 6> kPasses = {{{0.6, kFair, 1e-2, 32, 16, 12, 25},
                                          {0.6, kFair, 1e-7, 48, 24, 25, 30},
                                          {0.6, kSoft, 1e-7, 48, 24, 40, 30},
                                          {0.6, kSoft, 1e-7, 48, 24, 15, 50},
                                          {0.3, kSoft, 1e-7, 48, 24, 15, 50},
                                          {0.0, kSoft, 1e-7, 48, 24, 12, 50}}};
/// Where rails that are fair cover this much, none are made softer: a machine runs them better.
constexpr double kFairCovers = 0.998;
/// Where less is covered, the pass without a dead zone is left out.
constexpr double kCovered = 0.995;
/// Overcut below this share of the diagonal is settled: the constrained pass would not improve it.
constexpr double kSettledOvercutShare = 1e-6;

FitStage swept_stage(const Pass& pass, const FlankFitOptions& options) {
  FitStage stage;
  stage.samples_t = 120;  // of the regularisers
  stage.samples_s = 36;
  stage.control_points = pass.control_points;
  stage.tool_coefficients = pass.coefficients;
  stage.iterations = pass.iterations;
  stage.fairness = pass.fairness;
  stage.transversal_anchor = pass.anchor;
  stage.axial_pin = 1e-8;
  // Where the tool touches nothing it goes on as it came; where it touches, this is far below what the face asks.
  stage.tool_fairness = 1e-2 * options.tolerance_mm * options.tolerance_mm;
  stage.dead_zone_mm = pass.dead_zone * options.tolerance_mm;
  // What a strip cannot reach must not pull it off what it can.
  stage.robust_scale_mm = 20.0 * options.tolerance_mm;
  stage.overcut_weight = 4.0;
  stage.step_tolerance = 3e-4;
  return stage;
}

ReachLimits reach_of(const FlankFitOptions& options) { return {reach_radius(options), options.tolerance_mm}; }

double smallest_radius(const RadialFunction& tool) {
  constexpr int kSamples = 64;
  double least = tool.at(0.0).r;
  for (int j = 1; j <= kSamples; ++j) least = std::min(least, tool.at(tool.axis_length() * j / kSamples).r);
  return least;
}

}  // namespace

std::vector<FacePoint> target_points(const FitDraft& draft, int per_side, const ReachLimits& reach) {
  const std::vector<const Target*> targets = distinct_targets(draft);
  double area = 0.0;
  for (const Target* target : targets) area += target->area();
  std::vector<FacePoint> points;
  for (const Target* target : targets) {
    const double spacing = std::sqrt(target->area()) / per_side;
    std::vector<SurfaceSample> samples = target->samples(spacing);
    // The samples are middles of cells; a tool cuts deepest at the rim. A rim point stands for half a cell.
    for (const Vec3& point : target->border_points(spacing))
      samples.push_back({point, target->closest(point).normal, 0.5 * spacing * spacing});
    const std::size_t first = points.size();
    points.resize(first + samples.size());
    const FlankChecks* checks = checks_of(draft, target);
    parallel_for(samples.size(), [&](std::size_t k) {
      const bool out = checks != nullptr && !checks->reachable(samples[k], reach.radius_mm, reach.depth_mm);
      points[first + k] = {samples[k].point, samples[k].area / area, out};
    });
  }
  return points;
}

FitDraft run_swept(const FitDraft& draft, const RadiusBounds& bounds, const FitStage& stage,
                   std::vector<FacePoint> points, std::vector<IterationTrace>* trace) {
  FitDraft next;
  FitState start = start_state(draft, stage, next);
  const SweptModel model(std::move(points), draft.targets, start, next.free_parameters, bounds, stage, draft.checks);
  MinimiseResult result = levenberg_marquardt(model, std::move(start));
  if (trace) trace->insert(trace->end(), result.trace.begin(), result.trace.end());
  next.motions = std::move(result.state.motions);
  next.tool = result.state.tool;
  return next;
}

Polished swept_polish(const Polished& polished, const std::vector<SurfaceSample>& samples,
                      const FlankFitOptions& options, std::vector<IterationTrace>* trace) {
  Polished best = polished;
  bool fair = false;
  for (Pass pass : kPasses) {
    if (pass.fairness == kSoft && fair) pass.fairness = kFair;
    // The last one lowers what is left of the mean where nothing more is to be covered.
    if (pass.dead_zone == 0.0 && best.estimate.at_tolerance < kCovered) continue;
    const std::vector<FacePoint> points = target_points(best.draft, pass.points_per_side, reach_of(options));
    Polished trial =
        assess(run_swept(best.draft, options.bounds, swept_stage(pass, options), points, trace), samples, options);
    if (trial.estimate.score(options.tolerance_mm) > best.estimate.score(options.tolerance_mm)) best = std::move(trial);
    const CoverageEstimate& now = best.estimate;
    if (pass.fairness == kFair)
      fair = now.at_tolerance >= kFairCovers && std::max(now.overcut_mm, now.gouge_mm) <= options.tolerance_mm;
  }
  return best;
}

FitDraft run_constrained(const FitDraft& draft, const RadiusBounds& bounds, const FitStage& stage, double band_mm,
                         const ReachLimits& reach) {
  constexpr int kFirstPerSide = 40, kDensePerSide = 200;
  FitDraft next;
  const FitState start = start_state(draft, stage, next);
  ConstrainedProblem problem{draft.targets,
                             draft.checks,
                             next.free_parameters,
                             bounds,
                             stage,
                             target_points(draft, kFirstPerSide, reach),
                             target_points(draft, kDensePerSide, reach)};
  ConstrainedOptions options;
  // A sphere of radius r that touches half-way between two points is deeper there by spacing^2 / (8 r).
  const double spacing = std::sqrt(draft.targets.front()->area()) / kDensePerSide;
  options.allowed_overcut_mm = -spacing * spacing / (8.0 * smallest_radius(draft.tool));
  options.settled_mm = -0.5 * options.allowed_overcut_mm;
  options.band_mm = band_mm;
  ConstrainedResult result = minimise_constrained(problem, start, options);
  next.motions = std::move(result.state.motions);
  next.tool = result.state.tool;
  return next;
}

Polished without_overcut(const Polished& polished, const std::vector<SurfaceSample>& samples,
                         const FlankFitOptions& options) {
  const double diagonal = polished.draft.targets.front()->diagonal();
  // An exact fit would pay for its last digits of overcut with all of its error.
  const double settled = polished.exact ? std::max(kSettledOvercutShare * diagonal, 0.1 * options.tolerance_mm)
                                        : kSettledOvercutShare * diagonal;
  if (polished.draft.free_tool || polished.estimate.overcut_mm < settled) return polished;
  FitStage stage = swept_stage(kPasses[1], options);
  stage.dead_zone_mm = 0.0;
  stage.overcut_weight = 1.0;
  stage.fairness = 1e-4;
  const double band = 10.0 * options.tolerance_mm;
  Polished best =
      assess(run_constrained(polished.draft, options.bounds, stage, band, reach_of(options)), samples, options);
  if (best.estimate.overcut_mm >= polished.estimate.overcut_mm) return polished;
  // Least squares leaves up to three times the least possible material in places: once more, with what counts for
  // nothing taken out.
  stage.dead_zone_mm = std::min(0.5 * best.estimate.undercut_mm, 0.7 * options.tolerance_mm);
  Polished evened =
      assess(run_constrained(best.draft, options.bounds, stage, band, reach_of(options)), samples, options);
  const bool kept = evened.estimate.at_tolerance > best.estimate.at_tolerance - 1e-3 &&
                    evened.estimate.overcut_mm <= best.estimate.overcut_mm + kSettledOvercutShare * diagonal;
  if (kept && evened.estimate.undercut_mm < best.estimate.undercut_mm) best = std::move(evened);
  return best;
}

}  // namespace flank::internal
