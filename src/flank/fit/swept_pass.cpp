#include "flank/fit/swept_pass.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "flank/base/parallel.h"
#include "flank/fit/model/levenberg_marquardt.h"
#include "flank/fit/polished.h"

namespace flank::internal {

FitStage swept_stage(const SweptPass& pass, const FlankFitOptions& options, double size_mm) {
  /// A slide of 1 mm costs as much as a mean error of 1e-4 mm: it decides only what the face leaves open, as the slide
  /// of a cone on itself.
  constexpr double kAxialPin = 1e-8;
  /// A second difference of a hundredth of the size between a free tool's coefficients costs as much as a mean error of a
  /// tenth of the tolerance. Where the tool touches nothing it goes on as it came; where it touches, this is far below what
  /// the face asks.
  constexpr double kToolFairness = 100.0;
  /// Overcut of one length costs as much as material left of two: what is left can be finished by hand, what is cut is
  /// gone.
  constexpr double kOvercutWeight = 4.0;
  /// Where two places of the motion are equally near the cost has kinks, and a minimum is crept to: the last digits are
  /// not worth the contacts.
  constexpr double kStepTolerance = 1e-4;
  FitStage stage;
  stage.samples_t = kSamplesT;
  stage.samples_s = kSamplesS;
  stage.control_points = pass.control_points;
  stage.tool_coefficients = pass.coefficients;
  stage.iterations = pass.iterations;
  stage.fairness = fairness_of(pass.fairness, options.tolerance_mm, size_mm, kSamplesT);
  stage.transversal_anchor = pass.anchor;
  stage.axial_pin = kAxialPin;
  stage.tool_fairness = kToolFairness * (options.tolerance_mm / size_mm) * (options.tolerance_mm / size_mm);
  stage.dead_zone_mm = pass.dead_zone * options.tolerance_mm;
  stage.robust_scale_mm = pass.out_of_sight * options.tolerance_mm;
  stage.overcut_weight = kOvercutWeight * pass.firmness;
  stage.clear_weight *= pass.firmness;
  set_motion_weights(stage, options.tolerance_mm, size_mm);
  stage.step_tolerance = kStepTolerance;
  return stage;
}

std::vector<FacePoint> target_points(const FitDraft& draft, int per_side, const ReachLimits& reach) {
  const std::vector<const Target*> targets = distinct_targets(draft);
  double area = 0.0;
  for (const Target* target : targets) area += target->area();
  std::vector<FacePoint> points;
  for (const Target* target : targets) {
    // As many for each strip as one has alone: fewer than its rails have unknowns would hold it nowhere between them.
    const auto strips = static_cast<double>(std::count(draft.targets.begin(), draft.targets.end(), target));
    const double spacing = std::sqrt(target->area() / strips) / per_side;
    std::vector<SurfaceSample> samples = target->samples(spacing);
    // The samples are middles of cells; a tool cuts deepest at the rim. A rim point stands for half a cell.
    constexpr double kRimCell = 0.5;  // of a cell's area
    for (const Vec3& point : target->border_points(spacing))
      samples.push_back({point, target->closest(point).normal, kRimCell * spacing * spacing});
    const std::size_t first = points.size();
    points.resize(first + samples.size());
    const ObstacleField* obstacles = obstacles_of(draft, target);
    parallel_for(samples.size(), [&](std::size_t k) {
      const bool out = !is_reachable(*target, obstacles, samples[k], reach);
      points[first + k] = {samples[k].point, samples[k].area / area,
                           out ? FacePoint::Role::kOutOfReach : FacePoint::Role::kTouch};
    });
  }
  return points;
}

FitDraft run_swept(const FitDraft& draft, const RadiusBounds& bounds, const FitStage& stage,
                   std::vector<FacePoint> points, std::vector<IterationTrace>* trace) {
  FitDraft next;
  FitState start = start_state(draft, stage, next);
  const SweptModel model(std::move(points), draft.targets, start, next.free_parameters, bounds, stage_of(draft, stage),
                         draft.obstacles);
  MinimiseResult result = levenberg_marquardt(model, std::move(start));
  if (trace) trace->insert(trace->end(), result.trace.begin(), result.trace.end());
  next.motions = std::move(result.state.motions);
  next.tool = result.state.tool;
  return next;
}

}  // namespace flank::internal
