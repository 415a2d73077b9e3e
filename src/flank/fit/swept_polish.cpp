#include "flank/fit/swept_polish.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "flank/base/stopping.h"
#include "flank/base/tolerance_budget.h"
#include "flank/fit/lengthen.h"
#include "flank/fit/model/constrained.h"
#include "flank/fit/swept_pass.h"
#include "flank/motion/stagger.h"

namespace flank::internal {
namespace {

/// If fair rails cover this much, none are made softer: a machine runs them better, and what softness could gain is 4
/// of the 2,000 samples that rank drafts.
constexpr double kFairCovers = 0.998;
/// Overcut below this share of the diagonal is settled: the constrained pass would not improve it, whose own fairness
/// of kConstrainedFairness costs residuals of that size: sqrt(fairness) D / (kSamplesT - 1)^2 = 7e-7 D.
constexpr double kSettledOvercutShare = 1e-6;
constexpr double kConstrainedFairness = 1e-4;

/// Least r(s). The parameters of a family may leave it without a value past what touches the face: then the least of
/// those that it has, by samples, because it only sets a margin.
double smallest_radius(const RadialFunction& tool) {
  const double exact = tool.smallest();
  if (!std::isnan(exact)) return exact;
  constexpr int kSamples = 64;
  double least = tool.at(0.0).r;
  for (int j = 1; j <= kSamples; ++j) least = std::min(least, tool.at(tool.axis_length() * j / kSamples).r);
  return least;
}

/// A pass of the best so far. It minimises its own cost, not the score: its result counts only if the score agrees.
Polished with_pass(const Polished& best, const SweptPass& pass, const std::vector<SurfaceSample>& samples,
                   const FlankFitOptions& options, std::vector<IterationTrace>* trace) {
  const std::vector<FacePoint> points = target_points(best.draft, pass.points_per_side, reach_of(options));
  const FitStage stage = swept_stage(pass, options, best.draft.targets.front()->diagonal());
  Polished trial = assess(run_swept(best.draft, options.bounds, stage, points, trace), samples, options);
  return trial.estimate.score(options.tolerance_mm) > best.estimate.score(options.tolerance_mm) ? trial : best;
}

/// Of a pass that takes an envelope to its last digits.
FitStage envelope_stage(bool last, const FlankFitOptions& options, double size) {
  // Where the face holds no pose, past its ends, these alone keep the rails from waving, and leave 2e-8 and 3e-8 of the size elsewhere.
  constexpr double kFirstFairness = 1e-7, kLastFairness = 1e-6;
  constexpr int kIterations = 30;
  FitStage stage = swept_stage(kMean, options, size);
  const FitStage exact = exact_stage(last);
  stage.control_points = exact.control_points;
  stage.samples_t = exact.samples_t;
  stage.samples_s = exact.samples_s;
  stage.fairness = last ? kLastFairness : kFirstFairness;
  stage.tool_fairness = exact.tool_fairness;
  stage.axial_pin = exact.axial_pin;
  stage.plunge_weight = stage.lag_weight = 0.0;
  stage.overcut_weight = 1.0;
  stage.iterations = kIterations;
  stage.step_tolerance = exact.step_tolerance;
  return stage;
}

}  // namespace

Polished swept_polish(const Polished& polished, const std::vector<SurfaceSample>& samples,
                      const FlankFitOptions& options, std::vector<IterationTrace>* trace, const IsEnough& enough,
                      bool begun) {
  Polished best = polished;
  const auto fair_is_enough = [&] {
    const CoverageEstimate& now = best.estimate;
    return now.at_tolerance >= kFairCovers && std::max(now.overcut_mm, now.gouge_mm) <= options.tolerance_mm;
  };
  bool fair = begun && fair_is_enough();
  std::vector<SweptPass> passes(kOtherPasses.begin(), kOtherPasses.end());
  if (!begun) passes.insert(passes.begin(), kFirstPasses.begin(), kFirstPasses.end());
  for (SweptPass pass : passes) {
    if (stopping()) break;
    if (pass.fairness == kSoft && fair) pass.fairness = kFair;
    // The last one lowers what is left of the mean, if nothing more is to be covered.
    if (pass.dead_zone == 0.0 && best.estimate.at_tolerance < kAllButCovered) continue;
    best = with_pass(best, pass, samples, options, trace);
    if (pass.fairness == kFair) fair = fair_is_enough();
    if (enough && enough(best)) break;
  }
  return best;
}

Polished first_passes(const Polished& polished, const std::vector<SurfaceSample>& samples,
                      const FlankFitOptions& options, std::vector<IterationTrace>* trace) {
  Polished best = polished;
  for (const SweptPass& pass : kFirstPasses)
    if (!stopping()) best = with_pass(best, pass, samples, options, trace);
  return best;
}

Polished refine_exact_envelope(const Polished& polished, const std::vector<SurfaceSample>& samples,
                               const FlankFitOptions& options, std::vector<IterationTrace>* trace) {
  constexpr double kEnvelope = 3e-5;  // of the size, as kExactShare (polish.cpp) at the axis
  // A given tool was lifted out of all overcut: its mean error is that of the lift, and says less of what is possible.
  constexpr double kLifted = 1e-4;
  // Of the mean error, at most, after a pass: else it is no envelope, or there is no more to gain. Beside walls it takes three or four.
  constexpr double kEnvelopeGains = 0.9;
  constexpr int kMostPasses = 5;
  constexpr double kRunOn = 0.02;          // of the motion's time, at both ends: no pose at an end leaves the border
  constexpr double kNearlyCovered = 0.98;  // by the samples: what misses more has something else to mend first
  const double size = polished.draft.targets.front()->diagonal();
  // A rough distance of a thin tool is off by more than an exact fit is.
  const Polished start = assess(polished.draft, samples, options, Refined::kAll);
  const CoverageEstimate& estimate = start.estimate;
  const double nearest = polished.draft.free_tool ? kEnvelope : kLifted;
  if (stopping() || estimate.at_tolerance < kNearlyCovered || estimate.rms_mm > nearest * size) return polished;
  const std::vector<FacePoint> points = target_points(polished.draft, kMean.points_per_side, reach_of(options));
  Polished best = start, trial = start;
  trial.draft = run_on(start.draft, kRunOn);
  for (int pass = 0; pass < kMostPasses && !stopping(); ++pass) {
    const FitStage stage = envelope_stage(pass > 0, options, size);
    const double last_rms = trial.estimate.rms_mm;
    trial = assess(run_swept(trial.draft, options.bounds, stage, points, trace), samples, options, Refined::kAll);
    const CoverageEstimate &now = trial.estimate, &before = best.estimate;
    if (now.rms_mm > kEnvelopeGains * std::min(last_rms, before.rms_mm)) break;
    const double deepest = std::max(before.overcut_mm, exact_overcut(trial.draft, options.tolerance_mm));
    // Other faces may be entered by as much as the terms that keep the tool out of them allow: they end where the face begins, to
    // the digits of their border.
    const double entered = std::max(before.gouge_mm, kToleranceBudget.others.fit_allowance * options.tolerance_mm);
    const bool keeps = now.at_tolerance >= before.at_tolerance && now.overcut_mm <= deepest &&
                       now.gouge_mm <= entered && (now.largest_c < 1.0 || now.largest_c <= before.largest_c);
    if (!keeps) continue;
    best = trial;
    best.exact = true;
  }
  return best;
}

Polished reduce_stagger(const Polished& polished, double least_coverage, const std::vector<SurfaceSample>& samples,
                        const FlankFitOptions& options, std::vector<IterationTrace>* trace) {
  /// Of the weight: as much as it takes, where the faces hold against it.
  constexpr std::array<double, 3> kFirmness = {1.0, 10.0, 100.0};
  /// Of the radius in the middle: a tool thinner by so much, which touches as well and makes all cycles longer, costs as much
  /// as a mean error of one tolerance.
  constexpr double kThinner = 0.05;
  /// A stagger below this bounds no step; one that is not less by this share has met what the faces need.
  constexpr double kNoStagger = 0.003, kLess = 0.9;
  Polished best = polished;
  best.draft.facing = true;
  best.estimate.stagger = mean_stagger(best.draft.motions);
  const double size = best.draft.targets.front()->diagonal();
  const auto allowed = [&](double before) { return std::max(before, options.tolerance_mm); };
  const double coverage = std::min(polished.estimate.at_tolerance, least_coverage);
  for (const double firmness : kFirmness) {
    if (stopping() || best.estimate.stagger < kNoStagger) break;
    FitStage stage = swept_stage(kFairRails, options, size);
    stage.parallel_weight *= firmness;
    const double thinner = kThinner * best.draft.tool.at(0.5 * best.draft.tool.axis_length()).r;
    stage.radius_pin = (options.tolerance_mm / thinner) * (options.tolerance_mm / thinner);
    const std::vector<FacePoint> points = target_points(best.draft, kFairRails.points_per_side, reach_of(options));
    Polished trial = assess(run_swept(best.draft, options.bounds, stage, points, trace), samples, options);
    const CoverageEstimate& now = trial.estimate;
    const bool keeps = now.at_tolerance >= coverage && now.overcut_mm <= allowed(polished.estimate.overcut_mm) &&
                       now.gouge_mm <= allowed(polished.estimate.gouge_mm) &&
                       (now.largest_c < 1.0 || now.largest_c <= polished.estimate.largest_c);
    if (!keeps || now.stagger > kLess * best.estimate.stagger) break;
    best = std::move(trial);
    best.exact = false;
  }
  return best;
}

FitDraft steady_pass(const FitDraft& draft, const FlankFitOptions& options, double firmness) {
  FitStage stage = swept_stage(kFairRails, options, draft.targets.front()->diagonal());
  stage.bounds_at_knots = true;
  stage.plunge_weight *= firmness;
  stage.lag_weight *= firmness;
  return run_swept(draft, options.bounds, stage, target_points(draft, kFairRails.points_per_side, reach_of(options)),
                   nullptr);
}

FitDraft run_constrained(const FitDraft& draft, const RadiusBounds& bounds, const FitStage& stage, double band_mm,
                         const ReachLimits& reach) {
  // The dense set sets the margin below: at 200 a side it is spacing^2 / (8 r) = 2e-4 mm for a face of 40 mm and a tool
  // of 25 mm radius, 1e-3 mm for one of 5. The first set is the objective and the first limits; dense points join where
  // their limit breaks.
  constexpr int kFirstPerSide = 40, kDensePerSide = 200;
  FitDraft next;
  const FitState start = start_state(draft, stage, next);
  ConstrainedProblem problem{draft.targets,
                             draft.obstacles,
                             next.free_parameters,
                             bounds,
                             stage_of(draft, stage),
                             target_points(draft, kFirstPerSide, reach),
                             target_points(draft, kDensePerSide, reach)};
  ConstrainedOptions options;
  // A sphere of radius r that touches half-way between two points is deeper there by spacing^2 / (8 r).
  const double spacing = std::sqrt(draft.targets.front()->area()) / kDensePerSide;
  options.allowed_overcut_mm = -spacing * spacing / (8.0 * smallest_radius(draft.tool));
  // So at most half of the margin is left as overcut half-way between two points.
  options.settled_mm = -0.5 * options.allowed_overcut_mm;
  options.band_mm = band_mm;
  ConstrainedResult result = minimise_constrained(problem, start, options);
  next.motions = std::move(result.state.motions);
  next.tool = result.state.tool;
  return next;
}

Polished without_overcut(const Polished& polished, const std::vector<SurfaceSample>& samples,
                         const FlankFitOptions& options) {
  if (stopping()) return polished;
  const double diagonal = polished.draft.targets.front()->diagonal();
  // To take the last digits of overcut out of an exact fit costs it the last digits of everything else.
  const double least = kSettledOvercutShare * diagonal;
  const double settled = polished.exact ? std::max(least, exact_overcut(polished.draft, options.tolerance_mm)) : least;
  if (polished.draft.free_tool || polished.estimate.overcut_mm < settled) return polished;
  /// In tolerances. Points farther from the tool do not limit a step; a step that all the same makes one of them
  /// overcut is refused by its merit (constrained.cpp).
  constexpr double kBand = 10.0;
  /// The dead zone of the second run: half of the largest material left, but not more than the tolerance pass has.
  constexpr double kUndercutShare = 0.5, kMostZone = kToleranceBudget.fit.dead_zone_axis;
  /// Coverage that evening out may cost: 2 of the 2,000 samples that rank.
  constexpr double kCost = 1e-3;
  // No overcut to weigh, and no dead zone: the limits are hard, and the objective is the material left.
  FitStage stage = swept_stage(kFairRails, options, diagonal);
  stage.dead_zone_mm = 0.0;
  stage.overcut_weight = 1.0;
  stage.fairness = kConstrainedFairness;
  const double band = kBand * options.tolerance_mm;
  Polished best =
      assess(run_constrained(polished.draft, options.bounds, stage, band, reach_of(options)), samples, options);
  if (best.estimate.overcut_mm >= polished.estimate.overcut_mm) return polished;
  if (stopping()) return best;
  // Least squares leaves up to three times the least possible material in places: once more, with what counts for
  // nothing taken out.
  stage.dead_zone_mm = std::min(kUndercutShare * best.estimate.undercut_mm, kMostZone * options.tolerance_mm);
  Polished evened =
      assess(run_constrained(best.draft, options.bounds, stage, band, reach_of(options)), samples, options);
  const bool kept = evened.estimate.at_tolerance > best.estimate.at_tolerance - kCost &&
                    evened.estimate.overcut_mm <= best.estimate.overcut_mm + kSettledOvercutShare * diagonal;
  if (kept && evened.estimate.undercut_mm < best.estimate.undercut_mm) best = std::move(evened);
  return best;
}

}  // namespace flank::internal
