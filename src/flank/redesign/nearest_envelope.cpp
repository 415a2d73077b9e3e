#include "flank/redesign/nearest_envelope.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "flank/base/parallel.h"
#include "flank/base/stopping.h"
#include "flank/envelope/swept_estimate.h"
#include "flank/fit/lengthen.h"
#include "flank/fit/model/constrained.h"
#include "flank/fit/passes.h"
#include "flank/fit/swept_pass.h"

namespace flank::internal {
namespace {

/// Fewer control points than a fit takes: what is left over need not be followed, and a smooth motion is one that another fit of
/// the answer finds again.
constexpr SweptPass kNearestPass = {.dead_zone = 0.0,
                                    .fairness = 1e-3,
                                    .anchor = 1.0,
                                    .control_points = 14,
                                    .coefficients = 12,
                                    .iterations = 40,
                                    .points_per_side = 36,
                                    .out_of_sight = 0.0};
/// Of the way: how much more than the face needs a motion runs.
constexpr double kOverrun = 0.07, kHookShare = 0.04;
/// Points past the border: how far, of the diagonal, and what all of them weigh beside the face.
constexpr std::array<double, 2> kPastBorder = {0.02, 0.04};
constexpr double kPastWeight = 0.02;
constexpr int kDensePerSide = 90;  ///< of the points at which the limits are held
constexpr int kLawsonRounds = 10, kLawsonIterations = 6;
/// Of the first pass: so few control points that nothing is left of the waves and slides of the start.
constexpr int kFewPoints = 10;
constexpr double kFairPin = 1e-5, kPin = 1e-6;
constexpr double kStepTolerance = 1e-6;
constexpr double kFree = 1e6;  ///< mm: a limit that never binds

FitStage stage_for(const NearestProblem& problem) {
  FlankFitOptions options;
  options.tolerance_mm = problem.tolerance_mm;
  FitStage stage = swept_stage(kNearestPass, options, problem.start.targets.front()->diagonal());
  stage.overcut_weight = 1.0;  // a designer does not prefer a side
  stage.step_tolerance = kStepTolerance;
  stage.axial_pin = kPin;
  return stage;
}

/// Times at which a motion first and last touches its face, but for a little at both ends: there a fit lets it hook, so that poses
/// beyond the border finish it.
std::pair<double, double> used_range(const FitDraft& draft, std::size_t motion) {
  const Target& target = *draft.targets[motion];
  const SweptEstimate swept({draft.motions[motion]}, draft.tool, kRankingPoses);
  std::vector<double> times;
  for (const SurfaceSample& sample : target.samples(target.diagonal() / 40.0))
    times.push_back(swept.refine(sample.point, swept.nearest(sample.point)).t);
  std::sort(times.begin(), times.end());
  const auto out = static_cast<std::size_t>(kHookShare * static_cast<double>(times.size()));
  return {times[out], times[times.size() - 1 - out]};
}

/// Points a little past the border, on the extension of the face: a motion that ends at the border, or before it, would leave there what
/// its last pose is, and no envelope. Beside walls only where a ball of the tool has room.
std::vector<Vec3> points_past_border(const FitDraft& one, const ReachLimits& reach) {
  const Target& target = *one.targets.front();
  const ObstacleField* obstacles = obstacles_of(one, &target);
  const double spacing = kPastBorder.front() * target.diagonal();
  const std::vector<SurfaceSample> inside = target.samples(spacing);
  std::vector<Vec3> past;
  for (const Vec3& b : target.border_points(spacing)) {
    const Footpoint foot = target.closest(b);
    const auto nearest = std::min_element(inside.begin(), inside.end(), [&](const auto& x, const auto& y) {
      return (x.point - b).squaredNorm() < (y.point - b).squaredNorm();
    });
    Vec3 out = b - nearest->point;
    out -= out.dot(foot.normal) * foot.normal;
    for (const double share : kPastBorder) {
      if (!(out.norm() > 0.0)) continue;
      const Footpoint there = target.track(b + share * target.diagonal() * out.normalized(), foot);
      if (there.location != Location::kExtension) continue;
      if (is_reachable(target, obstacles, {there.point, there.normal, 0.0, 0.0, 0.0, 0}, reach))
        past.push_back(there.point);
    }
  }
  return past;
}

/// Points of all faces, weighted, and of those with a limit another one that holds it.
std::vector<FacePoint> weighted_points(const NearestProblem& problem, int per_side, bool limits_alone) {
  std::vector<FacePoint> all;
  const double faces = static_cast<double>(problem.start.targets.size());
  for (std::size_t k = 0; k < problem.start.targets.size(); ++k) {
    FitDraft one;
    one.targets = {problem.start.targets[k]};
    one.motions = {problem.start.motions[k]};
    if (!problem.start.obstacles.empty()) one.obstacles = {problem.start.obstacles[k]};
    for (FacePoint& point : target_points(one, per_side, problem.reach)) {
      point.share *= problem.weight[k](point.point) / faces;
      // What cannot be reached pulls nowhere, neither up nor down.
      if (point.role == FacePoint::Role::kTouch && !limits_alone) all.push_back(point);
      if (problem.least.empty()) continue;
      all.push_back({point.point, 0.0, FacePoint::Role::kHold, problem.least[k](point.point)});
    }
    if (limits_alone) continue;
    const std::vector<Vec3> past = points_past_border(one, problem.reach);
    for (const Vec3& p : past)
      all.push_back({p, kPastWeight / (faces * static_cast<double>(past.size())), FacePoint::Role::kTouch, 0.0});
  }
  return all;
}

std::vector<double> deviations(const FitDraft& draft, const std::vector<FacePoint>& points) {
  const SweptEstimate swept(draft.motions, draft.tool, kRankingPoses);
  std::vector<double> f(points.size());
  parallel_for(points.size(),
               [&](std::size_t k) { f[k] = swept.refine(points[k].point, swept.nearest(points[k].point)).f; });
  return f;
}

void measure(const std::vector<FacePoint>& points, const std::vector<double>& f, NearestEnvelope& out) {
  double squares = 0.0, shares = 0.0;
  out.largest_mm = out.violation_mm = 0.0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (points[k].one_sided()) {
      out.violation_mm = std::max(out.violation_mm, points[k].margin_mm - f[k]);
      continue;
    }
    squares += points[k].share * f[k] * f[k];
    shares += points[k].share;
    out.largest_mm = std::max(out.largest_mm, std::abs(f[k]));
  }
  out.rms_mm = shares > 0.0 ? std::sqrt(squares / shares) : 0.0;
}

FitDraft pass(const NearestProblem& problem, const FitDraft& draft, const FitStage& stage,
              const std::vector<FacePoint>& points) {
  if (problem.least.empty()) return run_swept(draft, problem.bounds, stage, points, nullptr);
  FitDraft next;
  const FitState start = start_state(draft, stage, next);
  const ConstrainedProblem constrained{draft.targets,
                                       draft.obstacles,
                                       next.free_parameters,
                                       problem.bounds,
                                       stage_of(draft, stage),
                                       points,
                                       weighted_points(problem, kDensePerSide, true)};
  ConstrainedOptions options;
  options.allowed_overcut_mm = kFree;  // the limits are those of the points that hold
  options.band_mm = 10.0 * problem.tolerance_mm;
  options.settled_mm = 1e-3 * problem.tolerance_mm;
  ConstrainedResult result = minimise_constrained(constrained, start, options);
  next.motions = std::move(result.state.motions);
  next.tool = result.state.tool;
  return next;
}

/// Weights that grow where the deviation is large lead from the least mean square to the least largest deviation (Lawson).
void make_even(const NearestProblem& problem, FitStage stage, const Progress& progress, NearestEnvelope& best) {
  stage.iterations = kLawsonIterations;
  const std::vector<FacePoint> points = weighted_points(problem, kNearestPass.points_per_side, false);
  const auto weighted_largest = [&](const std::vector<double>& f) {
    double largest = 0.0;
    for (std::size_t k = 0; k < points.size(); ++k)
      if (!points[k].one_sided()) largest = std::max(largest, std::sqrt(points[k].share) * std::abs(f[k]));
    return largest;
  };
  std::vector<FacePoint> lawson = points;
  FitDraft draft = best.draft;
  std::vector<double> f = deviations(draft, points);
  double least = weighted_largest(f);
  for (int round = 0; round < kLawsonRounds && !progress.stop(); ++round) {
    double sum = 0.0, before = 0.0;
    for (std::size_t k = 0; k < points.size(); ++k) {
      before += lawson[k].share;
      lawson[k].share *= std::abs(f[k]);
      sum += lawson[k].share;
    }
    for (FacePoint& point : lawson) point.share *= before / sum;
    draft = pass(problem, draft, stage, lawson);
    f = deviations(draft, points);
    if (!has_values(draft) || weighted_largest(f) >= least) continue;
    least = weighted_largest(f);
    best.draft = draft;
    measure(points, f, best);
  }
}

}  // namespace

NearestEnvelope nearest_envelope(const NearestProblem& problem, const Progress& progress) {
  const FitStage stage = stage_for(problem);
  const std::vector<FacePoint> points = weighted_points(problem, kNearestPass.points_per_side, false);
  NearestEnvelope best;
  FitStage fair = stage;
  fair.control_points = kFewPoints;
  fair.fairness = fairness_of(kFair, problem.tolerance_mm, problem.start.targets.front()->diagonal(), stage.samples_t);
  fair.axial_pin = kFairPin;
  best.draft = pass(problem, pass(problem, problem.start, fair, points), stage, points);
  if (!has_values(best.draft)) best.draft = problem.start;
  measure(points, deviations(best.draft, points), best);
  if (problem.largest) make_even(problem, stage, progress, best);
  if (best.draft.free_tool) best.draft.tool = clamp_tool(best.draft.tool, problem.bounds);
  return best;
}

FitDraft evenly_run(const FitDraft& draft, const Longer& longer) {
  constexpr int kSteps = 2000, kPosesPerPoint = 8;
  FitDraft even = draft;
  const double axis = draft.free_tool ? draft.tool.axis_length() : 0.0, above = longer.top * axis,
               below = longer.tip * axis;
  if (above + below > 0.0) even.tool = lengthened(draft.tool, above, below);
  for (std::size_t k = 0; k < even.motions.size(); ++k) {
    const RuledMotion old = draft.motions[k];
    const auto [from, to] = used_range(draft, k);
    // Ways of the middle of the axis up to every step; past the ends it goes on straight.
    const double first = from - kOverrun - longer.motion, last = to + kOverrun + longer.motion;
    std::vector<Pose> fine;
    std::vector<double> way{0.0};
    for (int i = 0; i <= kSteps; ++i) {
      const double t = first + (last - first) * i / kSteps, inside = std::clamp(t, 0.0, 1.0);
      const AxisJet jet = old.jet(inside);
      const Vec3 u = (jet.u + (t - inside) * jet.u_d1).normalized();
      fine.push_back({jet.tip + (t - inside) * jet.tip_d1 - below * u, u});
      if (i > 0)
        way.push_back(
            way.back() +
            (fine[fine.size() - 1].at(0.5 * old.axis_length) - fine[fine.size() - 2].at(0.5 * old.axis_length)).norm());
    }
    std::vector<Pose> poses;
    std::vector<double> times;
    const int count = kPosesPerPoint * kNearestPass.control_points;
    std::size_t at = 0;
    for (int i = 0; i <= count; ++i) {
      times.push_back(static_cast<double>(i) / count);
      while (at + 2 < way.size() && way[at + 1] < times.back() * way.back()) ++at;
      const double part = (times.back() * way.back() - way[at]) / std::max(way[at + 1] - way[at], 1e-12);
      poses.push_back({(1.0 - part) * fine[at].tip + part * fine[at + 1].tip,
                       ((1.0 - part) * fine[at].axis + part * fine[at + 1].axis).normalized()});
    }
    even.motions[k] = fit_motion(poses, times, old.axis_length + above + below, kFewPoints);
  }
  return even;
}

}  // namespace flank::internal
