#include "flank/cover/tiles/smooth.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "flank/base/parallel.h"
#include "flank/envelope/swept_estimate.h"
#include "flank/fit/model/levenberg_marquardt.h"
#include "flank/fit/swept_polish.h"
#include "flank/strip/certify.h"

namespace flank::internal {
namespace {

/// Passes in turn: dead zone in tolerances, fairness, anchor, weight of overcut, iterations, points a side of the target.
struct Pass {
  double dead_zone, fairness, anchor, overcut_weight;
  int iterations, points_per_side;
};
constexpr std::array<Pass, 2> kPasses = {{{0.6, 1e-4, 1e-3, 4.0, 8, 25}, {0.6, 1e-6, 1e-7, 10.0, 12, 32}}};
/// Where a certificate fails: overcut counts above all.
constexpr Pass kLimitPass = {0.6, 1e-6, 1e-5, 50.0, 6, 32};
constexpr int kLimitRounds = 2;
constexpr double kEnough = 0.9985;      ///< covered share at which no further pass is run
constexpr double kCheckWeight = 300.0;  ///< of a point of another face against a point of the target
constexpr double kMarginShare = 0.6;    ///< of the tolerance: what a fit aims at where a certificate asks for all of it
constexpr double kDeepShare = 0.9, kDeepAimShare = 0.8;  ///< deeper places are held, to the latter, by a pass of limits
constexpr double kNear = 2.0;  ///< tolerances: how near another face is to be, to be looked at in a pass
constexpr std::size_t kMostCheckPoints = 800;

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
  stage.overcut_weight = pass.overcut_weight;
  stage.step_tolerance = 1e-3;
  return stage;
}

std::vector<RuledMotion> motions_of(const std::vector<CoverStrip>& strips) {
  std::vector<RuledMotion> motions;
  for (const CoverStrip& strip : strips) motions.push_back(strip.motion);
  return motions;
}

/// Those of the points whose f is below a bound, in their order.
std::vector<Vec3> points_below(const TileScene& scene, const std::vector<CoverStrip>& strips,
                               const std::vector<Vec3>& points, double bound) {
  const SweptEstimate swept(motions_of(strips), scene.radial, 60);
  std::vector<char> below(points.size(), 0);
  parallel_blocks(points.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) below[k] = swept.distance(points[k]) < bound ? 1 : 0;
  });
  std::vector<Vec3> result;
  for (std::size_t k = 0; k < points.size(); ++k)
    if (below[k] != 0) result.push_back(points[k]);
  return result;
}

/// Points of other faces that the tool of these strips enters, or nearly: the nearest one of each pose.
std::vector<FacePoint> check_points(const TileScene& scene, const std::vector<CoverStrip>& strips, double share) {
  const double tolerance = scene.options.tolerance_mm;
  std::vector<std::vector<FacePoint>> found(strips.size());
  parallel_for(strips.size(), [&](std::size_t k) {
    const RuledMotion& motion = strips[k].motion;
    const int poses = depth_poses(motion);
    for (int i = 0; i <= poses; ++i) {
      const LineClearance at = scene.guard.measure(motion.pose(static_cast<double>(i) / poses), kNear * tolerance);
      if (at.clearance_mm < kNear * tolerance)
        found[k].push_back({at.point, share, FacePoint::Role::kAvoid, -kMarginShare * tolerance});
    }
  });
  std::vector<FacePoint> points;
  for (const auto& of_strip : found) points.insert(points.end(), of_strip.begin(), of_strip.end());
  return points;
}

/// Points of the target where the tool of these strips cuts nearly as deep as the tolerance allows, or deeper.
std::vector<FacePoint> deep_points(const TileScene& scene, const std::vector<CoverStrip>& strips, double share) {
  const double tolerance = scene.options.tolerance_mm;
  std::vector<std::vector<Vec3>> found(strips.size());
  parallel_for(strips.size(), [&](std::size_t k) {
    LineFitter fitter(scene.target, scene.radial, line_options(scene));
    const RuledMotion& motion = strips[k].motion;
    const int poses = depth_poses(motion);
    for (int i = 0; i <= poses; ++i) {
      const Pose pose = motion.pose(static_cast<double>(i) / poses);
      (void)fitter.measure(pose);
      fitter.deep_points(pose, kDeepShare * tolerance, found[k]);
    }
  });
  std::vector<FacePoint> points;
  found.push_back(points_below(scene, strips, scene.samples.border, -kDeepShare * tolerance));
  std::size_t count = 0, seen = 0;
  for (const auto& of_strip : found) count += of_strip.size();
  const std::size_t stride = 1 + count / kMostCheckPoints;
  for (const auto& of_strip : found)
    for (const Vec3& x : of_strip)
      if (seen++ % stride == 0) points.push_back({x, share, FacePoint::Role::kHold, -kDeepAimShare * tolerance});
  return points;
}

std::vector<CoverStrip> measured(const TileScene& scene, const std::vector<RuledMotion>& motions) {
  std::vector<CoverStrip> strips(motions.size());
  parallel_for(motions.size(), [&](std::size_t k) {
    LineFitter fitter(scene.target, scene.radial, line_options(scene));
    strips[k] = measure_strip(scene.samples, motions[k], scene.radial, fitter);
  });
  return strips;
}

/// Strips that cut too deep are lifted; those that fail their certificate all the same are cut short, or as they were
/// before, whichever covers more besides the others.
std::vector<CoverStrip> with_fallbacks(const TileScene& scene, const std::vector<CoverStrip>& strips,
                                       const std::vector<CoverStrip>& before, int& fallen) {
  std::vector<CoverStrip> result(strips.size());
  std::vector<char> good(strips.size());
  parallel_for(strips.size(), [&](std::size_t k) {
    LineFitter fitter(scene.target, scene.radial, line_options(scene));
    result[k] = lifted(scene.samples, scene.guard, strips[k], scene.radial, fitter);
    good[k] = is_certified(scene.guard, result[k], scene.options.tolerance_mm) ? 1 : 0;
    if (good[k] == 0)
      result[k] = cut_to_certified(scene.samples, scene.guard, std::move(result[k]), scene.radial, fitter);
  });
  CellCount covered(scene.samples);
  for (const CoverStrip& strip : result) covered.add(strip);
  fallen = 0;
  for (std::size_t k = 0; k < strips.size(); ++k) {
    if (good[k] != 0) continue;
    ++fallen;
    covered.add(result[k], -1);
    if (covered.gain(before[k]) > covered.gain(result[k])) result[k] = before[k];
    covered.add(result[k]);
  }
  return result;
}

/// Points of the target, spread evenly; those that the tool cannot reach count for overcut alone.
std::vector<FacePoint> points_to_fit(const TileScene& scene, const FitDraft& draft, int per_side) {
  std::vector<FacePoint> points = target_points(draft, per_side);
  parallel_for(points.size(), [&](std::size_t k) {
    const Vec3& x = points[k].point;
    if (!scene.guard.ball_is_clear(x + scene.guard.ball_radius() * scene.target.closest(x).normal))
      points[k].role = FacePoint::Role::kOutOfReach;
  });
  return points;
}

std::vector<RuledMotion> run_pass(const TileScene& scene, const std::vector<CoverStrip>& strips, const Pass& pass,
                                  int control_points, bool limits) {
  const FitDraft draft = draft_of(scene, strips);
  std::vector<FacePoint> points = points_to_fit(scene, draft, pass.points_per_side);
  const double share = kCheckWeight / static_cast<double>(points.size());
  const std::vector<FacePoint> others = check_points(scene, strips, share);
  points.insert(points.end(), others.begin(), others.end());
  if (limits) {
    const std::vector<FacePoint> deep = deep_points(scene, strips, share);
    points.insert(points.end(), deep.begin(), deep.end());
  }
  const FitStage stage = stage_of(pass, scene, control_points);
  return run_swept(draft, RadiusBounds{}, stage, std::move(points), nullptr).motions;
}

}  // namespace

std::vector<CoverStrip> remeasured(const TileScene& scene, const std::vector<CoverStrip>& strips) {
  return measured(scene, motions_of(strips));
}

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
  return samples.area > 0.0 ? area / samples.area : 0.0;
}

SmoothResult smooth_strips(const TileScene& scene, const std::vector<CoverStrip>& strips) {
  SmoothResult best{strips, covered_share(scene.samples, strips)};
  std::vector<CoverStrip> now = strips;
  bool first = true;
  int control_points = scene.options.control_points;
  for (const Pass& pass : kPasses) {
    now = measured(scene, run_pass(scene, now, pass, control_points, false));
    int fallen = 0;
    std::vector<CoverStrip> trial = with_fallbacks(scene, now, best.strips, fallen);
    for (int round = 0; round < kLimitRounds && fallen > 0; ++round) {
      // Rails that are too stiff for what they have to do get twice as many points, not a worse tolerance.
      if (round > 0) control_points = 2 * scene.options.control_points;
      now = measured(scene, run_pass(scene, now, kLimitPass, control_points, true));
      trial = with_fallbacks(scene, now, best.strips, fallen);
    }
    const double share = covered_share(scene.samples, trial);
    // The first pass is kept for its fair rails as well, where it costs next to nothing.
    constexpr double kFairnessWorth = 2e-3;
    if (share > best.coverage - (first ? kFairnessWorth : 0.0)) {
      best.coverage = share;
      best.strips = std::move(trial);
    }
    first = false;
    if (best.coverage >= kEnough) break;
  }
  return best;
}

}  // namespace flank::internal
