#include "flank/fit/stages.h"

#include <algorithm>
#include <numeric>

#include "flank/base/assert.h"
#include "flank/base/stopping.h"
#include "flank/base/tolerance_budget.h"
#include "flank/fit/model/minimise.h"

namespace flank::internal {
namespace {

/// Samples per control point (or coefficient) when a curve is refitted with another number of them: enough that least
/// squares is as good as the best approximation.
constexpr int kResamples = 8;

/// The motion with `count` control points a rail. Not by knot insertion: counts also go down, and knots stay equal.
RuledMotion with_control_points(const RuledMotion& motion, int count) {
  if (motion.tip.count() == count && motion.direction.count() == count) return motion;
  std::vector<Pose> poses;
  std::vector<double> times;
  const int samples = kResamples * std::max(count, motion.tip.count());
  for (int i = 0; i <= samples; ++i) {
    times.push_back(static_cast<double>(i) / samples);
    poses.push_back(motion.pose(times.back()));
  }
  return fit_motion(poses, times, motion.axis_length, count);
}

/// Any radial function as a spline of `count` coefficients.
RadialFunction with_coefficients(const RadialFunction& tool, int count) {
  if (tool.family() == ToolFamily::kSpline && tool.parameter_count() == count) return tool;
  std::vector<Vec2> samples;
  const int n = kResamples * count;
  for (int j = 0; j <= n; ++j) {
    const double s = tool.axis_length() * j / n;
    samples.emplace_back(s, tool.at(s).r);
  }
  return RadialFunction::spline_through(tool.axis_length(), samples, count);
}

}  // namespace

std::vector<const Target*> distinct_targets(const FitDraft& draft) {
  std::vector<const Target*> targets;
  for (const Target* target : draft.targets)
    // By address: two targets with the same faces are two. A draft has a handful, so a set would gain nothing.
    if (std::find(targets.begin(), targets.end(), target) == targets.end()) targets.push_back(target);
  return targets;
}

const ObstacleField* obstacles_of(const FitDraft& draft, const Target* target) {
  for (std::size_t m = 0; m < draft.obstacles.size(); ++m)
    if (draft.targets[m] == target) return draft.obstacles[m];
  return nullptr;
}

FitStage stage_of(const FitDraft& draft, const FitStage& stage) {
  FitStage own = stage;
  if (!draft.facing) own.parallel_weight = 0.0;
  return own;
}

bool has_values(const FitDraft& draft) {
  const auto finite = [](const RuledMotion& m) { return m.tip.poles.allFinite() && m.direction.poles.allFinite(); };
  return std::all_of(draft.motions.begin(), draft.motions.end(), finite) && draft.tool.parameters().allFinite();
}

FitState start_state(const FitDraft& draft, const FitStage& stage, FitDraft& next) {
  FLANK_ASSERT(draft.targets.size() == draft.motions.size() && !draft.motions.empty());
  FLANK_ASSERT(draft.obstacles.empty() || draft.obstacles.size() == draft.motions.size());
  FitState start;
  for (const RuledMotion& motion : draft.motions)
    start.motions.push_back(with_control_points(motion, stage.control_points));
  start.tool = draft.free_tool ? with_coefficients(draft.tool, stage.tool_coefficients) : draft.tool;
  next = draft;
  // All coefficients of a free spline may change, and their number has just been set.
  if (draft.free_tool) {
    next.free_parameters.resize(static_cast<std::size_t>(start.tool.parameter_count()));
    std::iota(next.free_parameters.begin(), next.free_parameters.end(), 0);
  }
  return start;
}

FitDraft run_stage(const FitDraft& draft, const RadiusBounds& bounds, const FitStage& stage,
                   std::vector<IterationTrace>* trace, ResidualSummary* summary) {
  if (stopping()) return draft;
  FitDraft next;
  FitState start = start_state(draft, stage, next);
  const FitModel model(draft.targets, start, next.free_parameters, bounds, stage_of(draft, stage), draft.obstacles);
  MinimiseResult result = minimise(model, std::move(start));
  if (trace) trace->insert(trace->end(), result.trace.begin(), result.trace.end());
  if (summary) *summary = summarise_residuals(model, result.state);
  next.motions = std::move(result.state.motions);
  next.tool = result.state.tool;
  return next;
}

// The presets. Three bounds are behind their weights (fit_stage.h): on an exact envelope, a term of weight w that is
// off by e at the truth leaves a residual of at most sqrt(w) e. With D the size of the target:
// - fairness: rails that bend by about D over the motion have second differences of D / (samples_t - 1)^2;
// - axial_pin and radius_pin: e is how far tip or radius still have to go, counted from the start of this pass;
// - transversal_anchor: moving along the path is nearly a change of timing alone, so the truth has e near 0 for any w.

FitStage quick_stage(double robust_scale_mm) {
  // Fifty starts pass through this one, and it only has to tell which of them lead somewhere: sizes and iterations are
  // those that MATH section 7 found to do it in a second.
  return {
      .samples_t = 40,
      .samples_s = 12,
      .control_points = 8,
      .tool_coefficients = 6,
      .iterations = 12,
      .fairness = 1e-2,  // at most 7e-5 D left: a hundredth of what a start is off by
      // Strong, because nothing else keeps a motion that does not fit yet from collapsing.
      .transversal_anchor = 1.0,
      .axial_pin = 1e-3,  // too stiff for the end result, right for a start that may slide (MATH section 7)
      // What a start does not touch yet must not pull it off what it does.
      .robust_scale_mm = robust_scale_mm,
      .extension_scale_mm = robust_scale_mm,
      .clear_estimated = true,
      .step_tolerance = 1e-3,  // more digits do not change a ranking by coverage
  };
}

FitStage polish_stage(double robust_scale_mm) {
  return {
      .iterations = 25,
      // At most 1e-6 D left: below kExactShare (polish.cpp), which this pass decides.
      .fairness = 1e-4,
      .transversal_anchor = 1e-2,
      // The pins leave at most 3e-3 of the slide and 1e-3 of the change in radius that is still to come.
      .axial_pin = 1e-5,
      .radius_pin = 1e-6,
      // Inside the target plain least squares: robust weights would hide overcut.
      .extension_scale_mm = robust_scale_mm,
      .clear_stride = 2,
      .step_tolerance = 1e-3,
  };
}

FitStage exact_stage(bool last) {
  FitStage stage{
      .samples_t = 120,
      .samples_s = 36,
      .control_points = 48,
      .tool_coefficients = 24,
      .iterations = 15,   // a few: near a zero residual Gauss-Newton converges quadratically
      .fairness = 1e-10,  // at most 7e-10 D left: exact envelopes are fitted to 1e-8 D
      .tool_fairness = 1e-12,
      .transversal_anchor = 1e-4,
      // The pins leave at most 1e-4 of what tip and radius still have to go.
      .axial_pin = 1e-8,
      .radius_pin = 1e-8,
      .extension_weight = 0.0,  // an extrapolated surface is not exact, and from here the pose no longer leaves
      .step_tolerance = 1e-3,
  };
  if (!last) return stage;
  // The same with room for what 48 control points cannot follow, and a hundredth of every weight: a tenth of every
  // bound, or less.
  stage.samples_t = 180;
  stage.control_points = 64;
  stage.radius_pin = 1e-10;
  stage.fairness = 1e-12;
  stage.transversal_anchor = 1e-6;
  stage.axial_pin = 1e-10;
  return stage;
}

void set_motion_weights(FitStage& stage, double tolerance_mm, double size_mm) {
  const double unit = (tolerance_mm / size_mm) * (tolerance_mm / size_mm);
  stage.plunge_weight = kPlungeShare * unit;
  stage.lag_weight = kLagShare * unit;
  stage.parallel_weight = kParallelShare * unit;
}

double fairness_of(double share, double tolerance_mm, double size_mm, int samples) {
  const double bend = size_mm / ((samples - 1.0) * (samples - 1.0));
  return share * (tolerance_mm / bend) * (tolerance_mm / bend);
}

FitStage tolerance_stage(double tolerance_mm, double robust_scale_mm, double size_mm) {
  constexpr int kSamples = 120;
  /// In the dead zone no residual stands against it (MATH section 7).
  constexpr double kFairness = 1e-3;
  FitStage stage{
      // Finer than the polish: the resolution at which MATH section 7 had its last candidates polished.
      .samples_t = kSamples,
      .samples_s = 36,
      .control_points = 32,
      .tool_coefficients = 16,
      .iterations = 40,
      .fairness = fairness_of(kFairness, tolerance_mm, size_mm, kSamples),
      .transversal_anchor = 1e-2,
      .axial_pin = 1e-6,
      .extension_scale_mm = robust_scale_mm,
      .dead_zone_mm = kToleranceBudget.fit.dead_zone_axis * tolerance_mm,
      .clear_stride = 2,
      .step_tolerance = 1e-3,
  };
  set_motion_weights(stage, tolerance_mm, size_mm);
  return stage;
}

RadialFunction clamp_tool(const RadialFunction& tool, const RadiusBounds& bounds) {
  FLANK_ASSERT(bounds.smallest <= bounds.largest);
  if (tool.family() != ToolFamily::kSpline) return tool;
  return tool.with_parameters(tool.parameters().cwiseMax(bounds.smallest).cwiseMin(bounds.largest));
}

}  // namespace flank::internal
