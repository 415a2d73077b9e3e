#include "flank/fit/coverage.h"

#include <algorithm>
#include <cmath>

#include "flank/base/parallel.h"
#include "flank/base/tolerance_budget.h"
#include "flank/base/work_count.h"
#include "flank/envelope/swept_estimate.h"
#include "flank/fit/model/shank_balls.h"

namespace flank {
namespace {

// The score in one unit, shares of coverage. Coverage first; among fits that cover the same, the lower overcut.

/// Of a share that is only within four tolerances, against one that is finished (which has both, 1.2). It leads fits
/// that cover little to those whose rest is near; a finished share is worth six near ones, so it is never given up for
/// one.
constexpr double kNearWorth = 0.2;
/// Per tolerance of overcut, or of depth in an obstacle, beyond the first one, which is allowed. The first tolerance
/// of excess fails the part, so it costs kFirstExcess times that on top: 10 % of coverage. From kMostExcess on it is
/// the same failure, however deep: 28 % at most.
constexpr double kExcessPrice = 0.02, kFirstExcess = 4.0, kMostExcess = 10.0;
/// Depths in obstacles go far beyond that: a start can lie across the hub, hundreds of tolerances deep. So that less
/// deep is still better, their price grows on, to another 20 % (kGougeExcess times kExcessPrice) at kDeepest
/// tolerances.
constexpr double kGougeExcess = 10.0, kDeepest = 100.0;
/// Of overcut that the tolerance allows, and of the root mean square error, each per tolerance. Both only break ties: a
/// percent of coverage is worth more than both. Radii reduced by a length lower the overcut by it and raise the mean
/// error by up to as much; with the mean dearer than the overcut, a tool in the middle of the tolerance is not shifted
/// off it.
constexpr double kAllowedOvercutPrice = 0.005, kMeanPrice = 0.006;

/// Of a motion that plunges where it touches, by what |c| is above 1, at most kMostPlunging: there the machine wobbles on
/// the spot. A percent of coverage is worth half of it.
constexpr double kPlungingPrice = 0.02, kMostPlunging = 1.0;
/// Of a motion during which nothing could hold the tool, and that much again times its share: no result at all, but one that covers all may lead
/// to one.
constexpr double kUnheldPrice = 0.12;
/// Likewise of a motion that turns more sharply than it may, which is no result either, for each angle beyond it, at most one.
constexpr double kTurnPrice = 0.1, kMostTurns = 1.0;

/// Of a stagger as long as the axis, where it counts. Among motions that cover the same the most nearly parallel ones: a
/// stagger of 0.1 can halve the steps of a cavity's cycles. A percent of coverage is worth half of that.
constexpr double kStaggerPrice = 0.2;

}  // namespace

double CoverageEstimate::score(double tolerance_mm) const {
  const auto excess_of = [&](double depth) {
    const double beyond = std::clamp(depth / tolerance_mm - 1.0, 0.0, kMostExcess);
    return beyond + kFirstExcess * std::min(1.0, beyond);
  };
  const double depth = kGougeExcess * std::min(1.0, gouge_mm / (kDeepest * tolerance_mm));
  const double excess = excess_of(overcut_mm) + excess_of(gouge_mm) + depth;
  const double within = kAllowedOvercutPrice * std::min(1.0, overcut_mm / tolerance_mm);
  const double held = unheld > 0.0 ? kUnheldPrice * (1.0 + unheld) : 0.0;
  return at_tolerance - held + kNearWorth * at_four_tolerances - kExcessPrice * excess - within -
         kMeanPrice * std::min(1.0, rms_mm / tolerance_mm) -
         kPlungingPrice * std::clamp(largest_c - 1.0, 0.0, kMostPlunging) -
         kTurnPrice * std::clamp(turn - 1.0, 0.0, kMostTurns) - kStaggerPrice * stagger;
}

}  // namespace flank

namespace flank::internal {
namespace {

/// f at the samples. The estimate is good enough to rank coverage, which is an average. Overcut is a maximum: one
/// sample that is off would decide it, so samples that seem cut are refined.
std::vector<double> estimate_distances(const std::vector<SurfaceSample>& samples,
                                       const std::vector<RuledMotion>& motions, const RadialFunction& tool, int poses,
                                       Refined refined) {
  constexpr std::size_t kGrain = 256;  // samples per task: the estimate takes microseconds each
  const SweptEstimate swept(motions, tool, poses);
  std::vector<double> distances(samples.size());
  count_work(samples.size());
  parallel_blocks(samples.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    SweptContact near;  // of the sample before: mostly a neighbour
    for (std::size_t k = begin; k < end; ++k) {
      near = swept.nearest(samples[k].point, near);
      distances[k] = near.f;
      if ((near.f < 0.0 || refined == Refined::kAll) && near.motion >= 0)
        distances[k] = swept.refine(samples[k].point, near).f;
    }
  });
  return distances;
}

/// Along the axis, at most: balls a sixtieth of the axis apart overlap almost wholly.
constexpr int kGougeSteps = 60;

/// Flank and shank as balls along the axis.
struct AxisBalls {
  const RadialFunction& flank;
  double shank = 0.0;  ///< radius of its balls
  double end = 0.0;    ///< of the axis with the shank

  AxisBalls(const RadialFunction& tool, const RadiusBounds& bounds)
      : flank(tool), shank(shank_ball(tool, bounds)), end(tool.axis_length()) {
    if (bounds.shank_in_the_way) end += bounds.shank_length;
  }

  [[nodiscard]] double step() const { return flank.axis_length() / kGougeSteps; }
  [[nodiscard]] double radius(double s) const { return s > flank.axis_length() ? shank : flank.at(s).r; }
  /// Where to look after `s`, of which the gap changes by at most twice the step (|r'| < 1): what is clear by it stays so for half of it. The
  /// flank's end is never left out: the radius may jump there.
  [[nodiscard]] double next(double s, double gap) const {
    const double stop = s < flank.axis_length() ? flank.axis_length() : end;
    return std::min(stop, s + std::max(step(), 0.5 * gap));
  }
};

/// How deep the tool enters an obstacle in a pose, >= 0, and where.
struct Deepest {
  double mm = 0.0, s = 0.0;
};

/// Of the ball about a place of the axis from the obstacle.
double gap_at(const Vec3& p, double radius, const ObstacleField& obstacles, double close_mm, GougeLook look) {
  const double gap = obstacles.estimate(p).distance_mm - radius;
  if (gap >= close_mm) return gap;
  const double near = obstacles.interpolated(p, radius + close_mm).distance_mm - radius;
  // Interpolation is off by a small part of the allowance: what is clear by all of it enters nothing.
  if (look != GougeLook::kClose || near > obstacles.allowance_mm()) return near;
  return obstacles.at(p, radius + close_mm).distance_mm - radius;
}

Deepest deepest_place(const Pose& pose, const ObstacleField& obstacles, const AxisBalls& balls, GougeLook look) {
  // Of the axis length: about the step of the lattice of distances (1/48 of the target's size). If the estimate is
  // nearer than that, the ball may touch, and the exact distance is asked for.
  constexpr double kClose = 0.02;
  const double close = kClose * balls.flank.axis_length();
  Deepest deepest;
  for (double s = 0.0;;) {
    const double gap = gap_at(pose.at(s), balls.radius(s), obstacles, close, look);
    if (-gap > deepest.mm) deepest = {-gap, s};
    if (s >= balls.end) return deepest;
    s = balls.next(s, gap);
  }
}

/// Calls look(place, radius, rough distance) along the axis.
template <class Look>
void look_along(const Pose& pose, const ObstacleField& obstacles, const AxisBalls& balls, const Look& look) {
  for (double s = 0.0;;) {
    const Vec3 p = pose.at(s);
    const double r = balls.radius(s);
    const ObstacleField::Rough about = obstacles.rough(p);
    look(p, r, about);
    if (s >= balls.end) return;
    s = balls.next(s, about.distance_mm - about.off_mm - r);
  }
}

/// The largest of depth(pose), >= 0.
template <class Depth>
double largest(const RuledMotion& motion, int poses, const Depth& depth) {
  std::vector<double> depths(static_cast<std::size_t>(poses) + 1, 0.0);
  parallel_for(depths.size(), [&](std::size_t i) { depths[i] = depth(motion.pose(static_cast<double>(i) / poses)); });
  return std::max(0.0, *std::max_element(depths.begin(), depths.end()));
}

/// The deepest place of a motion: estimated if it is surely inside, for how deep does not matter then; else exactly, where the
/// flank may touch.
double rough_depth(const RuledMotion& motion, const ObstacleField& obstacles, const AxisBalls& balls, int poses) {
  const double inside = largest(motion, poses, [&](const Pose& pose) {
    double surely = 0.0;
    look_along(pose, obstacles, balls, [&](const Vec3&, double r, const ObstacleField::Rough& about) {
      if (about.distance_mm + about.off_mm < r) surely = std::max(surely, r - about.distance_mm);
    });
    return surely;
  });
  if (inside > 0.0) return inside;
  return largest(motion, poses, [&](const Pose& pose) {
    double found = 0.0;
    look_along(pose, obstacles, balls, [&](const Vec3& p, double r, const ObstacleField::Rough& about) {
      if (about.distance_mm - about.off_mm < r - found)
        found = std::max(found, r - obstacles.interpolated(p, r - found).distance_mm);
    });
    return found;
  });
}

/// The depth about the deepest place, closer: balls h apart leave up to h^2 / (8 r) of the flank between them.
double between_places(const Pose& pose, const ObstacleField& obstacles, const AxisBalls& balls, const Deepest& found) {
  constexpr int kCloser = 8;  // times: a 64th of what lies between is left
  if (found.mm <= 0.0) return 0.0;
  const double step = balls.step();
  double deepest = found.mm;
  for (int k = -kCloser; k <= kCloser; ++k) {
    const double s = std::clamp(found.s + step * k / kCloser, 0.0, balls.end), r = balls.radius(s);
    deepest = std::max(deepest, r - obstacles.at(pose.at(s), r).distance_mm);
  }
  return deepest;
}

}  // namespace

std::vector<Vec3> cut_deeper_than(double depth_mm, const std::vector<SurfaceSample>& samples,
                                  const std::vector<RuledMotion>& motions, const RadialFunction& tool, int poses) {
  const std::vector<double> distances = estimate_distances(samples, motions, tool, poses, Refined::kCuts);
  std::vector<Vec3> deep;
  for (std::size_t k = 0; k < samples.size(); ++k)
    if (distances[k] < -depth_mm) deep.push_back(samples[k].point);
  return deep;
}

CoverageEstimate estimate_coverage(const std::vector<SurfaceSample>& samples, const std::vector<RuledMotion>& motions,
                                   const RadialFunction& tool, double tolerance_mm, int poses, Refined refined) {
  constexpr double kNearTolerances = 4.0;  // by the field's name
  const std::vector<double> distances = estimate_distances(samples, motions, tool, poses, refined);
  CoverageEstimate estimate;
  double area = 0.0, whole = 0.0, near_area = 0.0, squares = 0.0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const SurfaceSample& sample = samples[k];
    const double f = distances[k];
    const double reached = std::max(0.0, sample.area);
    area += reached;
    whole += std::abs(sample.area);
    if (std::abs(f) <= tolerance_mm) {
      estimate.at_tolerance += reached;
      estimate.of_whole += std::abs(sample.area);
    }
    // The root mean square is that of what may still be finished: places out of reach would drown it.
    if (std::abs(f) <= kNearTolerances * tolerance_mm) {
      estimate.at_four_tolerances += reached;
      near_area += reached;
      squares += reached * f * f;
    }
    estimate.overcut_mm = std::max(estimate.overcut_mm, -f);
    estimate.undercut_mm = std::max(estimate.undercut_mm, f);
  }
  if (area > 0.0) {
    estimate.at_tolerance /= area;
    estimate.at_four_tolerances /= area;
  }
  if (whole > 0.0) estimate.of_whole /= whole;
  if (near_area > 0.0) estimate.rms_mm = std::sqrt(squares / near_area);
  return estimate;
}

double flank_gouge(const std::vector<RuledMotion>& motions, const std::vector<const ObstacleField*>& obstacles,
                   const RadialFunction& tool, const RadiusBounds& bounds, int poses, GougeLook look) {
  const AxisBalls balls(tool, bounds);
  double deepest = 0.0;
  for (std::size_t m = 0; m < obstacles.size(); ++m) {
    if (obstacles[m] == nullptr) continue;
    const auto depth_of = [&](const Pose& pose) {
      const Deepest found = deepest_place(pose, *obstacles[m], balls, look);
      return look == GougeLook::kClose ? between_places(pose, *obstacles[m], balls, found) : found.mm;
    };
    deepest = std::max(deepest, look == GougeLook::kRough ? rough_depth(motions[m], *obstacles[m], balls, poses)
                                                          : largest(motions[m], poses, depth_of));
  }
  return deepest;
}

ResidualSummary validate(const std::vector<FitTask>& tasks, const RadialFunction& tool, int count_t, int count_s) {
  ResidualSummary summary;
  std::size_t inside = 0, all = 0;
  double squares = 0.0;
  for (const FitTask& task : tasks) {
    for (int i = 0; i < count_t; ++i) {
      const Pose pose = task.motion.pose(static_cast<double>(i) / (count_t - 1));
      for (int j = 0; j < count_s; ++j) {
        const double s = tool.axis_length() * j / (count_s - 1);
        // Cold: a footpoint tracked from its neighbour would repeat the mistake that this is to find.
        const Footpoint foot = task.target->closest(pose.at(s));
        ++all;
        if (foot.location != Location::kInside) continue;
        ++inside;
        const double e = foot.distance - tool.at(s).r;
        squares += e * e;
        summary.largest_mm = std::max(summary.largest_mm, std::abs(e));
        summary.largest_overcut_mm = std::max(summary.largest_overcut_mm, -e);
      }
    }
  }
  if (inside > 0) summary.rms_mm = std::sqrt(squares / static_cast<double>(inside));
  if (all > 0) summary.inside_share = static_cast<double>(inside) / static_cast<double>(all);
  return summary;
}

}  // namespace flank::internal
