#include "flank/pipeline/search/out_of_reach.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "flank/base/parallel.h"
#include "flank/fit/polished.h"

namespace flank::internal {

double reachable_share(const Target& target, const FlankFitOptions& options) {
  double all = 0.0, reached = 0.0;
  for (const SurfaceSample& sample : ranking_samples(target, options.obstacles, options)) {
    all += std::abs(sample.area);
    reached += std::max(0.0, sample.area);
  }
  return all > 0.0 ? reached / all : 1.0;
}

namespace {

/// Is there a way out for a tool that touches the target here: along the surface, or leaning away from it as a cone does?
bool can_be_held(const SurfaceSample& sample, double radius_mm, const FlankFitOptions& options) {
  constexpr int kAround = 24;
  constexpr std::array kLeans = {0.0, 0.25, 0.5};  // radians
  const Vec3 x = sample.normal.unitOrthogonal(), y = sample.normal.cross(x),
             from = sample.point + radius_mm * sample.normal;
  for (const double lean : kLeans)
    for (int k = 0; k < kAround; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / kAround;
      const Vec3 along = std::cos(angle) * x + std::sin(angle) * y;
      if (options.is_free_line(from, std::cos(lean) * along + std::sin(lean) * sample.normal)) return true;
    }
  return false;
}

}  // namespace

double holdable_share(const Target& target, const FlankFitOptions& options) {
  constexpr double kCoarser = 2.0;  // than what ranks drafts
  if (!options.is_free_line) return 1.0;
  const double radius = reach_radius(options);
  const auto samples = target.samples(kCoarser * std::sqrt(target.area()) * options.sample_share);
  std::vector<double> held(samples.size());
  parallel_for(samples.size(),
               [&](std::size_t k) { held[k] = can_be_held(samples[k], radius, options) ? samples[k].area : 0.0; });
  double all = 0.0;
  for (const SurfaceSample& sample : samples) all += sample.area;
  return all > 0.0 ? std::accumulate(held.begin(), held.end(), 0.0) / all : 1.0;
}

double ball_with_room(const Target& target, const FlankFitOptions& options, double radius_mm) {
  constexpr double kMostly = 0.5, kStep = 0.9, kLeast = 0.03;
  FlankFitOptions coarse = options;
  coarse.sample_share = 2.0 * options.sample_share;  // a share of a half needs no more
  for (double ball = radius_mm; ball > kLeast * radius_mm; ball *= kStep) {
    coarse.reach_radius_mm = ball;
    if (reachable_share(target, coarse) >= kMostly) return ball;
  }
  return radius_mm;
}

FlankFitOptions scouting_options(FlankFitOptions options) {
  options.strips = 1;
  options.search_without_obstacles = false;
  options.polished_candidates = options.finalists = 1;
  options.least_coverage_for_last_passes = 2.0;  // none
  return options;
}

std::string out_of_reach_note(double share, const FlankFitOptions& options) {
  return fmt::format(
      "on {1:.1f} % of its area the face is not accessible to a ball of radius {0:.3g} mm: it would gouge another "
      "face, or this one; try a smaller --reach-radius, or --ignore-faces",
      reach_radius(options), 100.0 * (1.0 - share));
}

std::string not_holdable_note(double share) {
  return fmt::format(
      "only on {:.1f} % of the face could a tool be held: elsewhere its axis, continued above the flank, runs into the "
      "part in every direction",
      100.0 * share);
}

}  // namespace flank::internal
