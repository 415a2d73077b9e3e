#include "flank/cover/smooth.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "flank/base/parallel.h"
#include "flank/envelope/swept_estimate.h"
#include "flank/fit/constrained.h"
#include "flank/fit/levenberg_marquardt.h"
#include "flank/fit/swept_polish.h"

namespace flank {
namespace {

/// Passes in turn: dead zone in tolerances, fairness, anchor, iterations, points a side of the target.
struct Pass {
  double dead_zone, fairness, anchor;
  int iterations, points_per_side;
};
constexpr std::array<Pass, 2> kPasses = {{{0.6, 1e-5, 1e-3, 8, 25}, {0.6, 1e-6, 1e-7, 16, 40}}};
constexpr double kCheckWeight = 4.0;   ///< of a point of another face against a point of the target
constexpr double kMarginShare = 0.85;  ///< of the tolerance: what a fit aims at where a certificate asks for all of it

FitDraft draft_of(const TileScene& scene, const std::vector<CoverStrip>& strips) {
  FitDraft draft;
  draft.tool = scene.radial;
  for (const CoverStrip& strip : strips) {
    draft.targets.push_back(&scene.target);
    draft.motions.push_back(strip.motion);
  }
  return draft;
}

FitStage stage_of(const Pass& pass, const TileScene& scene, int control_points) {
  FitStage stage;
  stage.samples_t = 80;  // of the regularisers
  stage.samples_s = 24;
  stage.control_points = control_points;
  stage.iterations = pass.iterations;
  stage.fairness = pass.fairness;
  stage.transversal_anchor = pass.anchor;
  stage.axial_pin = 1e-8;
  stage.dead_zone_mm = pass.dead_zone * scene.options.tolerance_mm;
  stage.robust_scale_mm = 20.0 * scene.options.tolerance_mm;
  stage.overcut_weight = 4.0;
  stage.step_tolerance = 1e-3;
  return stage;
}

/// Points of other faces that the swept tools come near: corners and middles of their triangles.
std::vector<FacePoint> check_points(const TileScene& scene, std::span<const CheckSurface> checks,
                                    const std::vector<CoverStrip>& strips, double share) {
  std::vector<RuledMotion> motions;
  for (const CoverStrip& strip : strips) motions.push_back(strip.motion);
  const SweptEstimate swept(motions, scene.radial, 60);
  const double near = std::max(10.0 * scene.options.tolerance_mm, 0.01 * scene.target.diagonal());
  Box3 box = scene.target.box();
  box.low.array() -= scene.radial.axis_length();
  box.high.array() += scene.radial.axis_length();
  std::vector<Vec3> candidates;
  for (const CheckSurface& check : checks) {
    if (check.flank_may_touch) continue;
    candidates.insert(candidates.end(), check.mesh.vertices.begin(), check.mesh.vertices.end());
    for (const auto& t : check.mesh.triangles)
      candidates.push_back((check.mesh.vertices[static_cast<std::size_t>(t[0])] +
                            check.mesh.vertices[static_cast<std::size_t>(t[1])] +
                            check.mesh.vertices[static_cast<std::size_t>(t[2])]) /
                           3.0);
  }
  std::vector<char> close(candidates.size(), 0);
  parallel_blocks(candidates.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      close[k] = box.squared_distance(candidates[k]) == 0.0 && swept.distance(candidates[k]) < near ? 1 : 0;
  });
  std::vector<FacePoint> points;
  for (std::size_t k = 0; k < candidates.size(); ++k)
    if (close[k] != 0) points.push_back({candidates[k], share, true, -kMarginShare * scene.options.tolerance_mm});
  return points;
}

std::vector<CoverStrip> measured(const TileScene& scene, const std::vector<RuledMotion>& motions) {
  std::vector<CoverStrip> strips(motions.size());
  parallel_for(motions.size(), [&](std::size_t k) {
    strips[k] = measure_strip(scene.samples, motions[k], scene.radial, scene.options.tolerance_mm);
  });
  return strips;
}

/// Strips that fail their certificate as they were before.
std::vector<CoverStrip> with_fallbacks(const TileScene& scene, std::vector<CoverStrip> strips,
                                       const std::vector<CoverStrip>& before, int& fallen) {
  std::vector<char> good(strips.size());
  parallel_for(strips.size(), [&](std::size_t k) { good[k] = certified(scene, strips[k]) ? 1 : 0; });
  fallen = 0;
  for (std::size_t k = 0; k < strips.size(); ++k) {
    if (good[k] != 0) continue;
    strips[k] = before[k];
    ++fallen;
  }
  return strips;
}

std::vector<RuledMotion> run_pass(const TileScene& scene, std::span<const CheckSurface> checks,
                                  const std::vector<CoverStrip>& strips, const FitStage& stage, int per_side) {
  const FitDraft draft = draft_of(scene, strips);
  std::vector<FacePoint> points = target_points(draft, per_side);
  const double share = kCheckWeight / static_cast<double>(points.size());
  const std::vector<FacePoint> others = check_points(scene, checks, strips, share);
  points.insert(points.end(), others.begin(), others.end());
  return run_swept(draft, RadiusBounds{}, stage, std::move(points), nullptr).motions;
}

/// Hard limits on overcut and on other faces (fit/constrained.h).
std::vector<RuledMotion> run_limited(const TileScene& scene, std::span<const CheckSurface> checks,
                                     const std::vector<CoverStrip>& strips, const FitStage& stage) {
  FitDraft next;
  const FitDraft draft = draft_of(scene, strips);
  const FitState start = start_state(draft, stage, next);
  ConstrainedProblem problem{draft.targets, {}, RadiusBounds{}, stage, target_points(draft, 40),
                             target_points(draft, 120)};
  const double share = kCheckWeight / static_cast<double>(problem.points.size());
  for (const FacePoint& point : check_points(scene, checks, strips, share)) {
    problem.points.push_back(point);
    problem.dense.push_back(point);
  }
  ConstrainedOptions options;
  options.allowed_overcut_mm = kMarginShare * scene.options.tolerance_mm;
  options.settled_mm = 0.05 * scene.options.tolerance_mm;
  options.band_mm = 10.0 * scene.options.tolerance_mm;
  options.exchanges = 3;
  return minimise_constrained(problem, start, options).state.motions;
}

}  // namespace

double covered_share(const CoverSamples& samples, const std::vector<CoverStrip>& strips) {
  std::vector<char> covered(samples.cells.size(), 0);
  double area = 0.0;
  for (const CoverStrip& strip : strips) {
    for (const int k : strip.cells) {
      char& flag = covered[static_cast<std::size_t>(k)];
      if (flag == 0) area += samples.cells[static_cast<std::size_t>(k)].area;
      flag = 1;
    }
  }
  return area / samples.area;
}

bool certified(const TileScene& scene, const CoverStrip& strip) {
  constexpr int kPoses = 120;
  if (strip.cells.empty() || strip.overcut_mm > scene.options.tolerance_mm) return false;
  for (int i = 0; i <= kPoses; ++i)
    if (!scene.guard.clear(strip.motion.pose(static_cast<double>(i) / kPoses))) return false;
  return true;
}

SmoothResult smooth_strips(const TileScene& scene, std::span<const CheckSurface> checks,
                           const std::vector<CoverStrip>& strips) {
  SmoothResult best{strips, covered_share(scene.samples, strips), {}};
  std::vector<CoverStrip> now = strips;
  for (const Pass& pass : kPasses) {
    const FitStage stage = stage_of(pass, scene, scene.options.control_points);
    now = measured(scene, run_pass(scene, checks, now, stage, pass.points_per_side));
    int fallen = 0;
    std::vector<CoverStrip> trial = with_fallbacks(scene, now, best.strips, fallen);
    if (fallen > 0) {
      now = measured(scene, run_limited(scene, checks, now, stage));
      trial = with_fallbacks(scene, now, best.strips, fallen);
    }
    const double share = covered_share(scene.samples, trial);
    if (share <= best.coverage) continue;
    best.coverage = share;
    best.strips = std::move(trial);
  }
  return best;
}

}  // namespace flank
