#include "flank/cover/tiles/smooth.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "flank/base/parallel.h"
#include "flank/base/stopping.h"
#include "flank/base/tolerance_budget.h"
#include "flank/envelope/swept_estimate.h"
#include "flank/fit/model/levenberg_marquardt.h"
#include "flank/fit/swept_pass.h"
#include "flank/strip/certify.h"

namespace flank::internal {
namespace {

/// First stiff and on few points, to straighten what was grown step by step; then with softer and softer rails and on more points: rails that
/// are soft at once wave where nothing holds them. The points of the face are fixed, so a motion gains nothing by shrinking
/// (fit/model/swept_model.h): the anchor only removes drift that changes no envelope, and later passes hardly need it.
constexpr std::array<SweptPass, 3> kPasses = {
    {{.fairness = kFair, .anchor = 1e-3, .iterations = 8, .points_per_side = 25},
     {.fairness = kYielding, .iterations = 12, .points_per_side = 32, .firmness = 2.5},
     {.iterations = 12, .points_per_side = 32, .firmness = 2.5}}};
/// After a failed certificate: overcut counts above all, and a stronger anchor keeps the strip in its place meanwhile.
constexpr SweptPass kLimitPass = {
    .fairness = kYielding, .anchor = 1e-5, .iterations = 6, .points_per_side = 32, .firmness = 12.5};
/// After a kink: the rails are fair again.
constexpr SweptPass kSteadyPass = {
    .fairness = kFair, .anchor = 1e-5, .iterations = 8, .points_per_side = 32, .firmness = 12.5};
/// Passes of limits: one with the rails as they are, one with twice as many control points.
constexpr int kLimitRounds = 2;
/// Covered share at which no further pass is run: the 0.15 % that are left are less than a third of a strip's default
/// price.
constexpr double kEnoughCoverage = 0.9985;
/// Weight of a point of another face, or of a deep point, as a multiple of the mean weight of a target point. These
/// points are few and their limits are hard, so one of them has to outweigh the target points around it. MATH section 7
/// uses 30 to 100 for such one-sided terms when every sample of the axis has one; here a pose has a single point, so it
/// weighs more.
constexpr double kLimitWeight = 300.0;
/// Tolerances. Another face farther than this from a pose gets no point in the pass: its term would be zero, unless the
/// pass moved the pose by more than two tolerances.
constexpr double kObstacleHorizon = 2.0;
/// Most deep points of one pass. With more, the limits would decide the fit by their number; every n-th is taken
/// instead.
constexpr std::size_t kMostDeepPoints = 800;
/// Poses per strip of the estimate that looks for deep border points, and points per task (enough work to be worth
/// handing out).
constexpr int kBorderPoses = 60;
constexpr std::size_t kBorderGrain = 256;
/// Covered share that the first pass may lose and still be kept: fairer rails are worth that to whoever mills them.
constexpr double kFairnessWorth = 2e-3;

FitDraft draft_of(const TileScene& scene, const std::vector<CoverStrip>& strips) {
  FitDraft draft;
  draft.tool = scene.radial;
  for (const CoverStrip& strip : strips) {
    draft.targets.push_back(&scene.target);
    draft.motions.push_back(strip.motion);
  }
  return draft;
}

FitStage stage_of(const SweptPass& pass, const TileScene& scene, int control_points) {
  FlankFitOptions options;
  options.tolerance_mm = scene.options.tolerance_mm;
  SweptPass own = pass;
  own.control_points = control_points;
  return swept_stage(own, options, scene.target.diagonal());
}

std::vector<RuledMotion> motions_of(const std::vector<CoverStrip>& strips) {
  std::vector<RuledMotion> motions;
  for (const CoverStrip& strip : strips) motions.push_back(strip.motion);
  return motions;
}

/// The points whose swept distance f is below a bound (mm), in their order.
std::vector<Vec3> points_below(const TileScene& scene, const std::vector<CoverStrip>& strips,
                               const std::vector<Vec3>& points, double bound) {
  const SweptEstimate swept(motions_of(strips), scene.radial, kBorderPoses);
  std::vector<char> below(points.size(), 0);
  parallel_blocks(points.size(), kBorderGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) below[k] = swept.distance(points[k]) < bound ? 1 : 0;
  });
  std::vector<Vec3> result;
  for (std::size_t k = 0; k < points.size(); ++k)
    if (below[k] != 0) result.push_back(points[k]);
  return result;
}

/// Points of other faces that the tool of these strips enters or nearly enters: for each pose the point that it enters
/// most or comes nearest to. `share` is the weight of each.
std::vector<FacePoint> check_points(const TileScene& scene, const std::vector<CoverStrip>& strips, double share) {
  const double tolerance = scene.options.tolerance_mm;
  std::vector<std::vector<FacePoint>> found(strips.size());
  parallel_for(strips.size(), [&](std::size_t k) {
    const RuledMotion& motion = strips[k].motion;
    const int poses = depth_poses(motion);
    for (int i = 0; i <= poses; ++i) {
      const SlideClearance at =
          scene.guard.measure(motion.pose(static_cast<double>(i) / poses), kObstacleHorizon * tolerance);
      if (at.clearance_mm < kObstacleHorizon * tolerance)
        found[k].push_back({.point = at.point,
                            .share = share,
                            .role = FacePoint::Role::kAvoid,
                            .margin_mm = -kToleranceBudget.others.aim * tolerance});
    }
  });
  std::vector<FacePoint> points;
  for (const auto& of_strip : found) points.insert(points.end(), of_strip.begin(), of_strip.end());
  return points;
}

/// Points of the target where the tool of these strips cuts nearly as deep as the tolerance allows, or deeper. Two
/// searches, because neither sees everything: the spheres of the axis against the inside of the target, and points of
/// the border against the swept tool, since at the border f has ridges that the spheres step over
/// (docs/algorithms/cover.md).
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
      fitter.deep_points(pose, kToleranceBudget.target.held * tolerance, found[k]);
    }
  });
  std::vector<FacePoint> points;
  found.push_back(points_below(scene, strips, scene.samples.border, -kToleranceBudget.target.held * tolerance));
  std::size_t count = 0, seen = 0;
  for (const auto& of_strip : found) count += of_strip.size();
  const std::size_t stride = 1 + count / kMostDeepPoints;
  for (const auto& of_strip : found)
    for (const Vec3& x : of_strip)
      if (seen++ % stride == 0)
        points.push_back({.point = x,
                          .share = share,
                          .role = FacePoint::Role::kHold,
                          .margin_mm = -kToleranceBudget.target.held_aim * tolerance});
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

/// How many strips of a pass failed their certificate, and how many of them by a kink.
struct Fallen {
  int all = 0, kinked = 0;
};

/// The largest of the pieces of a strip between its kinks.
CoverStrip longest_between_kinks(const TileScene& scene, CoverStrip strip, LineFitter& fitter) {
  if (strip.cells.empty()) return strip;
  std::vector<CoverStrip> pieces =
      cut_at_kinks(scene.samples, scene.guard, std::move(strip), scene.radial, fitter, turn_limit(scene));
  const auto largest = std::max_element(pieces.begin(), pieces.end(),
                                        [](const CoverStrip& a, const CoverStrip& b) { return a.area < b.area; });
  return largest == pieces.end() ? CoverStrip{} : std::move(*largest);
}

/// Each strip, or the largest of its pieces between kinks.
std::vector<CoverStrip> without_kinks(const TileScene& scene, std::vector<CoverStrip> strips) {
  parallel_for(strips.size(), [&](std::size_t k) {
    LineFitter fitter(scene.target, scene.radial, line_options(scene));
    strips[k] = longest_between_kinks(scene, std::move(strips[k]), fitter);
  });
  return strips;
}

/// Strips that cut too deep are lifted. One that still fails its certificate, or has a kink, is replaced by what can be certified of it
/// or by its predecessor in `before`, whichever adds more to what the other strips cover.
std::vector<CoverStrip> with_fallbacks(const TileScene& scene, const std::vector<CoverStrip>& strips,
                                       const std::vector<CoverStrip>& before, Fallen& fallen) {
  const double tolerance = scene.options.tolerance_mm;
  std::vector<CoverStrip> result(strips.size());
  std::vector<char> good(strips.size()), kinked(strips.size());
  parallel_for(strips.size(), [&](std::size_t k) {
    LineFitter fitter(scene.target, scene.radial, line_options(scene));
    result[k] = lifted(scene.samples, scene.guard, strips[k], scene.radial, fitter);
    kinked[k] = !result[k].cells.empty() && has_kink(result[k].motion, turn_limit(scene), tolerance) ? 1 : 0;
    good[k] = kinked[k] == 0 && is_certified(scene.guard, result[k], tolerance) ? 1 : 0;
    if (good[k] != 0) return;
    result[k] = cut_to_certified(scene.samples, scene.guard, std::move(result[k]), scene.radial, fitter);
    result[k] = longest_between_kinks(scene, std::move(result[k]), fitter);
  });
  CellCount covered(scene.samples);
  for (const CoverStrip& strip : result) covered.add(strip);
  // One after the other, in their order: each choice changes what is a gain for the next.
  fallen = {};
  for (std::size_t k = 0; k < strips.size(); ++k) {
    if (good[k] != 0) continue;
    ++fallen.all;
    fallen.kinked += kinked[k];
    covered.add(result[k], -1);
    if (covered.gain(before[k]) > covered.gain(result[k])) result[k] = before[k];
    covered.add(result[k]);
  }
  return result;
}

/// Points of the target, spread evenly. Those that the tool cannot reach count for overcut alone: as ordinary points
/// they would ask for contact, and on a blade they pulled the tips into the hub.
std::vector<FacePoint> points_to_fit(const TileScene& scene, const FitDraft& draft, int per_side) {
  std::vector<FacePoint> points = target_points(draft, per_side);
  parallel_for(points.size(), [&](std::size_t k) {
    const Vec3& x = points[k].point;
    if (!scene.guard.ball_is_clear(x + scene.guard.ball_radius() * scene.target.closest(x).normal))
      points[k].role = FacePoint::Role::kOutOfReach;
  });
  return points;
}

/// One pass over all strips together. `limits`: places that are too deep already are held as well.
std::vector<RuledMotion> run_pass(const TileScene& scene, const std::vector<CoverStrip>& strips, const SweptPass& pass,
                                  int control_points, bool limits) {
  const FitDraft draft = draft_of(scene, strips);
  std::vector<FacePoint> points = points_to_fit(scene, draft, pass.points_per_side);
  const double share = kLimitWeight / static_cast<double>(points.size());  // target points have 1 / size each
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

// `now` is what the fit goes on from, certified or not; `best` is what could be certified. They are apart because a fit
// from strips that were cut short would start with their gaps.
SmoothResult smooth_strips(const TileScene& scene, const std::vector<CoverStrip>& strips) {
  SmoothResult best{without_kinks(scene, strips), 0.0};
  best.coverage = covered_share(scene.samples, best.strips);
  std::vector<CoverStrip> now = strips;
  bool first = true;
  int control_points = scene.options.control_points;
  for (const SweptPass& pass : kPasses) {
    if (stopping()) break;
    now = measured(scene, run_pass(scene, now, pass, control_points, false));
    if (stopping()) break;
    Fallen fallen;
    std::vector<CoverStrip> trial = with_fallbacks(scene, now, best.strips, fallen);
    for (int round = 0; round < kLimitRounds && fallen.all > 0 && !stopping(); ++round) {
      // Rails that are too stiff for what they have to do get twice as many points, not a worse tolerance.
      if (round > 0) control_points = 2 * scene.options.control_points;
      now = measured(scene, run_pass(scene, now, fallen.kinked > 0 ? kSteadyPass : kLimitPass, control_points, true));
      trial = with_fallbacks(scene, now, best.strips, fallen);
    }
    const double share = covered_share(scene.samples, trial);
    if (share > best.coverage - (first ? kFairnessWorth : 0.0)) {
      best.coverage = share;
      best.strips = std::move(trial);
    }
    first = false;
    if (best.coverage >= kEnoughCoverage) break;
  }
  return best;
}

}  // namespace flank::internal
