#include "flank/fit/stages.h"

#include <algorithm>
#include <numeric>

#include "flank/base/assert.h"

namespace flank::internal {
namespace {

RuledMotion with_control_points(const RuledMotion& motion, int count) {
  if (motion.tip.count() == count && motion.direction.count() == count) return motion;
  std::vector<Pose> poses;
  std::vector<double> times;
  const int samples = 8 * std::max(count, motion.tip.count());
  for (int i = 0; i <= samples; ++i) {
    times.push_back(static_cast<double>(i) / samples);
    poses.push_back(motion.pose(times.back()));
  }
  return fit_motion(poses, times, motion.axis_length, count);
}

RadialFunction with_coefficients(const RadialFunction& tool, int count) {
  if (tool.family() == ToolFamily::kSpline && tool.parameter_count() == count) return tool;
  std::vector<Vec2> samples;
  const int n = 8 * count;
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
    if (std::find(targets.begin(), targets.end(), target) == targets.end()) targets.push_back(target);
  return targets;
}

const FlankChecks* checks_of(const FitDraft& draft, const Target* target) {
  for (std::size_t m = 0; m < draft.checks.size(); ++m)
    if (draft.targets[m] == target) return draft.checks[m];
  return nullptr;
}

FitState start_state(const FitDraft& draft, const FitStage& stage, FitDraft& next) {
  FLANK_ASSERT(draft.targets.size() == draft.motions.size() && !draft.motions.empty());
  FLANK_ASSERT(draft.checks.empty() || draft.checks.size() == draft.motions.size());
  FitState start;
  for (const RuledMotion& motion : draft.motions)
    start.motions.push_back(with_control_points(motion, stage.control_points));
  start.tool = draft.free_tool ? with_coefficients(draft.tool, stage.tool_coefficients) : draft.tool;
  next = draft;
  if (draft.free_tool) {
    next.free_parameters.resize(static_cast<std::size_t>(start.tool.parameter_count()));
    std::iota(next.free_parameters.begin(), next.free_parameters.end(), 0);
  }
  return start;
}

FitDraft run_stage(const FitDraft& draft, const RadiusBounds& bounds, const FitStage& stage,
                   std::vector<IterationTrace>* trace, ResidualSummary* summary) {
  FitDraft next;
  FitState start = start_state(draft, stage, next);
  const FitModel model(draft.targets, start, next.free_parameters, bounds, stage, draft.checks);
  MinimiseResult result = minimise(model, std::move(start));
  if (trace) trace->insert(trace->end(), result.trace.begin(), result.trace.end());
  if (summary) *summary = summarise_residuals(model, result.state);
  next.motions = std::move(result.state.motions);
  next.tool = result.state.tool;
  return next;
}

FitStage quick_stage(double robust_scale_mm) {
  FitStage stage;
  stage.samples_t = 40;
  stage.samples_s = 12;
  stage.control_points = 8;
  stage.tool_coefficients = 6;
  stage.iterations = 12;
  stage.fairness = 1e-2;
  stage.transversal_anchor = 1.0;
  stage.axial_pin = 1e-3;
  stage.robust_scale_mm = robust_scale_mm;
  stage.extension_scale_mm = robust_scale_mm;
  stage.step_tolerance = 1e-3;
  stage.clear_estimated = true;
  return stage;
}

FitStage polish_stage(double robust_scale_mm) {
  FitStage stage;
  stage.extension_scale_mm = robust_scale_mm;
  stage.iterations = 25;
  stage.radius_pin = 1e-6;
  stage.fairness = 1e-4;
  stage.transversal_anchor = 1e-2;
  stage.axial_pin = 1e-5;
  stage.step_tolerance = 1e-4;
  return stage;
}

FitStage exact_stage(bool last) {
  FitStage stage;
  stage.samples_t = 120;
  stage.samples_s = 36;
  stage.control_points = 48;
  stage.tool_coefficients = 24;
  stage.iterations = 15;
  stage.radius_pin = 1e-8;
  stage.fairness = 1e-10;
  stage.tool_fairness = 1e-12;
  stage.transversal_anchor = 1e-4;
  stage.axial_pin = 1e-8;
  stage.extension_weight = 0.0;
  stage.step_tolerance = 1e-3;
  if (!last) return stage;
  stage.samples_t = 180;
  stage.control_points = 64;
  stage.radius_pin = 1e-10;
  stage.fairness = 1e-12;
  stage.transversal_anchor = 1e-6;
  stage.axial_pin = 1e-10;
  return stage;
}

FitStage tolerance_stage(double tolerance_mm, double robust_scale_mm) {
  FitStage stage;
  stage.extension_scale_mm = robust_scale_mm;
  stage.samples_t = 120;
  stage.samples_s = 36;
  stage.control_points = 32;
  stage.tool_coefficients = 16;
  stage.iterations = 40;
  stage.fairness = 1e-5;
  stage.transversal_anchor = 1e-2;
  stage.axial_pin = 1e-6;
  stage.dead_zone_mm = 0.7 * tolerance_mm;
  stage.step_tolerance = 1e-4;
  return stage;
}

RadialFunction clamp_tool(const RadialFunction& tool, const RadiusBounds& bounds) {
  FLANK_ASSERT(bounds.smallest <= bounds.largest);
  if (tool.family() != ToolFamily::kSpline) return tool;
  return tool.with_parameters(tool.parameters().cwiseMax(bounds.smallest).cwiseMin(bounds.largest));
}

}  // namespace flank::internal
