#include "flank/fit/polished.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "flank/base/parallel.h"
#include "flank/base/tolerance_budget.h"
#include "flank/envelope/path_regularity.h"
#include "flank/error.h"
#include "flank/fit/coverage.h"
#include "flank/fit/rejected.h"
#include "flank/fit/starts/upper_end.h"
#include "flank/motion/stagger.h"
#include "flank/motion/written_path.h"
#include "flank/path/turning.h"
#include "flank/surface/ball_touch.h"

namespace flank::internal {

namespace {

/// |c| of a motion that is joined straight from pose to pose, where it touches its target; at least `known`.
double touching_c_of(const FitDraft& draft, std::size_t motion, std::span<const Pose> poses, double tolerance_mm,
                     double known) {
  const Touches touches = [&](const Vec3& centre, double ball_mm) {
    return ball_touches({&draft.targets[motion], 1}, centre, ball_mm, tolerance_mm);
  };
  for (std::size_t i = 0; i + 1 < poses.size(); ++i)
    known = largest_c(poses[i], poses[i + 1], draft.tool, touches, known);
  return known;
}

/// The poses of a motion, evenly spread over its time.
std::vector<Pose> even_poses(const RuledMotion& motion, int count) {
  std::vector<Pose> poses(static_cast<std::size_t>(count) + 1);
  for (std::size_t i = 0; i < poses.size(); ++i) poses[i] = motion.pose(static_cast<double>(i) / count);
  return poses;
}

/// |c| and turn of all motions, of the poses that `poses_of` lays on each.
template <class PosesOf>
void measure_motion(const FitDraft& draft, const FlankFitOptions& options, CoverageEstimate& estimate,
                    const PosesOf& poses_of) {
  double turn = 0.0;
  estimate.largest_c = 0.0;
  for (std::size_t m = 0; m < draft.motions.size(); ++m) {
    const RuledMotion& motion = draft.motions[m];
    const std::vector<Pose> poses = poses_of(motion);
    estimate.largest_c = touching_c_of(draft, m, poses, options.tolerance_mm, estimate.largest_c);
    const double own = turn_window(draft.targets[m]->diagonal());
    const double window = std::max(own, options.turn_window_mm);
    turn = std::max(turn, sharpest_turn(poses, motion.axis_length, window).angle_rad);
  }
  estimate.turn = turn / options.most_turn_rad;
}

}  // namespace

double touching_c(const FitDraft& draft, double tolerance_mm, int poses) {
  double largest = 0.0;
  for (std::size_t m = 0; m < draft.motions.size(); ++m)
    largest = touching_c_of(draft, m, even_poses(draft.motions[m], poses), tolerance_mm, largest);
  return largest;
}

void measure_written(const FitDraft& draft, const FlankFitOptions& options, CoverageEstimate& estimate) {
  const SamplingOptions written = written_path(options.tolerance_mm);
  try {
    measure_motion(draft, options, estimate,
                   [&](const RuledMotion& motion) { return sample_motion(motion, written).poses; });
  } catch (const InternalError&) {  // a pass that went wrong leaves rails without a direction
    estimate.largest_c = std::numeric_limits<double>::infinity();
  }
}

Polished assess(FitDraft draft, const std::vector<SurfaceSample>& samples, const FlankFitOptions& options) {
  return assess(std::move(draft), samples, options, Refined::kCuts);
}

Polished assess(FitDraft draft, const std::vector<SurfaceSample>& samples, const FlankFitOptions& options,
                Refined refined) {
  Polished polished;
  if (!has_values(draft)) {
    constexpr double kNever = std::numeric_limits<double>::infinity();
    polished.estimate.overcut_mm = polished.estimate.gouge_mm = polished.estimate.undercut_mm = kNever;
    polished.draft = std::move(draft);
    return polished;
  }
  if (draft.free_tool) draft.tool = clamp_tool(draft.tool, options.bounds);
  polished.estimate =
      estimate_coverage(samples, draft.motions, draft.tool, options.tolerance_mm, kRankingPoses, refined);
  polished.estimate.gouge_mm = flank_gouge(draft.motions, draft.obstacles, draft.tool, options.bounds, kRankingPoses);
  measure_motion(draft, options, polished.estimate,
                 [](const RuledMotion& motion) { return even_poses(motion, kRankingPoses); });
  polished.estimate.unheld = unheld_share(draft.motions, draft.tool, options);
  if (draft.free_tool) {
    polished.estimate.slenderness = slenderness_of(draft.tool, options.bounds);
    polished.estimate.least_slenderness = draft.tool.axis_length() / (2.0 * options.bounds.largest);
  }
  if (draft.facing) polished.estimate.stagger = mean_stagger(draft.motions);
  polished.draft = std::move(draft);
  return polished;
}

double exact_overcut(const FitDraft& draft, double tolerance_mm) {
  double off = 0.0;
  for (const Target* target : draft.targets) off = std::max(off, target->samples_off_mm());
  return std::min(kToleranceBudget.fit.exact_overcut * tolerance_mm + off, kToleranceBudget.fit.overcut * tolerance_mm);
}

double robust_scale(const Target& target, const FlankFitOptions& options) {
  // A robust weight is a quarter at the scale, so at four tolerances, which is what quick fits are ranked by, a sample
  // still pulls. With a tight tolerance everything about a start would be an outlier, and nothing pull: hence the
  // floor.
  constexpr double kTolerances = 4.0, kLeastShare = 1e-3;
  return std::max(kTolerances * options.tolerance_mm, kLeastShare * target.diagonal());
}

double reach_radius(const FlankFitOptions& options) {
  return options.reach_radius_mm > 0.0 ? options.reach_radius_mm : options.bounds.smallest;
}

ReachLimits reach_of(const FlankFitOptions& options) {
  return {reach_radius(options), options.tolerance_mm, options.reach_radius_mm > 0.0};
}

bool is_reachable(const Target& target, const ObstacleField* obstacles, const SurfaceSample& sample,
                  const ReachLimits& reach) {
  // By the triangles of a mesh, and not by the smooth surface, which bulges beside slivers.
  const SurfaceSample given = target.as_given(sample);
  if (reach.corners && !ball_fits(target, given, reach.radius_mm, reach.depth_mm)) return false;
  return obstacles == nullptr || obstacles->reachable(given, reach.radius_mm, reach.depth_mm);
}

std::vector<SurfaceSample> ranking_samples(const Target& target, const ObstacleField* obstacles,
                                           const FlankFitOptions& options) {
  const double spacing = std::sqrt(target.area()) * options.sample_share;
  const ReachLimits reach = reach_of(options);
  std::vector<SurfaceSample> samples = target.samples(spacing);
  parallel_for(samples.size(), [&](std::size_t k) {
    if (!is_reachable(target, obstacles, samples[k], reach)) samples[k].area = -samples[k].area;
  });
  // The rim, where a tool cuts deepest, counts for overcut alone: it has no area.
  for (const Vec3& point : target.border_points(spacing)) samples.push_back({point, Vec3::UnitZ()});
  for (const Vec3& point : options.extra_overcut_points) samples.push_back({point, Vec3::UnitZ()});
  return samples;
}

}  // namespace flank::internal
