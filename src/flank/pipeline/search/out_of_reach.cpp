#include "flank/pipeline/search/out_of_reach.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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

FlankFitOptions hardly_worth_it(FlankFitOptions options) {
  options.strips = 1;
  options.ways = false;
  options.kept_after_quick = options.kept_after_polish = 1;
  options.least_coverage_for_last_passes = 2.0;  // none
  return options;
}

std::string out_of_reach_note(double share, const FlankFitOptions& options) {
  return fmt::format(
      "other faces lie in front of the target or upon it, or it is a corner: a ball of radius {:.3g} mm that touches "
      "it enters them, or the target elsewhere, on {:.1f} % of its area; a smaller ball may reach it, and faces that "
      "are no obstacles can be ignored",
      reach_radius(options), 100.0 * (1.0 - share));
}

}  // namespace flank::internal
