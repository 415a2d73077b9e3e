#include <algorithm>
#include <cmath>

#include "flank/base/parallel.h"
#include "flank/envelope/swept_estimate.h"
#include "flank/fit/flank_fit.h"

namespace flank::internal {

double CoverageEstimate::score(double tolerance_mm) const {
  // Coverage first; among equals the lower overcut. Overcut beyond the tolerance fails the part: it costs ten percent of
  // coverage for the first tolerance, two for each one more.
  const auto excess_of = [&](double depth) {
    const double beyond = std::clamp(depth / tolerance_mm - 1.0, 0.0, 10.0);
    return beyond + 4.0 * std::min(1.0, beyond);
  };
  // Into other faces it can go so deep that ten tolerances are nothing; less deep is still better.
  const double depth = 10.0 * std::min(1.0, gouge_mm / (100.0 * tolerance_mm));
  const double excess = excess_of(overcut_mm) + excess_of(gouge_mm) + depth;
  // Within the tolerance the mean error counts for more, so that no tool is shifted off the middle of the face.
  const double within = 0.005 * std::min(1.0, overcut_mm / tolerance_mm);
  return at_tolerance + 0.2 * at_four_tolerances - 0.02 * excess - within -
         0.006 * std::min(1.0, rms_mm / tolerance_mm);
}

namespace {

/// f at the samples. The estimate is good enough to rank coverage; what would be called overcut is looked at closely.
std::vector<double> estimate_distances(const std::vector<SurfaceSample>& samples,
                                       const std::vector<RuledMotion>& motions, const RadialFunction& tool, int poses) {
  constexpr std::size_t kGrain = 256;
  const SweptEstimate swept(motions, tool, poses);
  std::vector<double> distances(samples.size());
  parallel_blocks(samples.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const SweptContact near = swept.nearest(samples[k].point);
      distances[k] = near.f;
      if (near.f >= 0.0 || near.motion < 0) continue;
      const RuledMotion& motion = motions[static_cast<std::size_t>(near.motion)];
      distances[k] = refine_contact(motion, tool, samples[k].point, near.t, swept.spacing()).f;
    }
  });
  return distances;
}

}  // namespace

CoverageEstimate estimate_coverage(const std::vector<SurfaceSample>& samples, const std::vector<RuledMotion>& motions,
                                   const RadialFunction& tool, double tolerance_mm, int poses) {
  const std::vector<double> distances = estimate_distances(samples, motions, tool, poses);
  CoverageEstimate estimate;
  double area = 0.0, near_area = 0.0, squares = 0.0;
  for (std::size_t k = 0; k < samples.size(); ++k) {
    const SurfaceSample& sample = samples[k];
    const double f = distances[k];
    area += sample.area;
    if (std::abs(f) <= tolerance_mm) estimate.at_tolerance += sample.area;
    if (std::abs(f) <= 4.0 * tolerance_mm) {
      estimate.at_four_tolerances += sample.area;
      near_area += sample.area;
      squares += sample.area * f * f;
    }
    estimate.overcut_mm = std::max(estimate.overcut_mm, -f);
    estimate.undercut_mm = std::max(estimate.undercut_mm, f);
  }
  if (area > 0.0) {
    estimate.at_tolerance /= area;
    estimate.at_four_tolerances /= area;
  }
  if (near_area > 0.0) estimate.rms_mm = std::sqrt(squares / near_area);
  return estimate;
}

double flank_gouge(const std::vector<RuledMotion>& motions, const std::vector<const FlankChecks*>& checks,
                   const RadialFunction& tool, int poses) {
  constexpr int kSteps = 60;  ///< along the axis, at most
  double deepest = 0.0;
  for (std::size_t m = 0; m < checks.size(); ++m) {
    if (checks[m] == nullptr) continue;
    std::vector<double> depths(static_cast<std::size_t>(poses) + 1, 0.0);
    const double length = motions[m].axis_length;
    parallel_for(depths.size(), [&](std::size_t i) {
      const Pose pose = motions[m].pose(static_cast<double>(i) / poses);
      for (double s = 0.0;; s = std::min(s, length)) {
        const double r = tool.at(s).r;
        // What the estimate calls far is not looked at closely.
        double gap = checks[m]->estimate(pose.at(s)).distance_mm - r;
        if (gap < 0.02 * length) gap = checks[m]->at(pose.at(s), r + 0.02 * length).distance_mm - r;
        depths[i] = std::max(depths[i], -gap);
        if (s >= length) break;
        // The gap changes by at most twice the step (|r'| < 1): what is clear by it stays so for half of it.
        s += std::max(length / kSteps, 0.5 * gap);
      }
    });
    deepest = std::max(deepest, *std::max_element(depths.begin(), depths.end()));
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
