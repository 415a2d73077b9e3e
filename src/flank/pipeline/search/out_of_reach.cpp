#include "flank/pipeline/search/out_of_reach.h"

#include <fmt/format.h>

#include <algorithm>

#include "flank/fit/polished.h"

namespace flank::internal {

double reachable_share(const Target& target, const FlankFitOptions& options) {
  if (options.obstacles == nullptr) return 1.0;
  const auto area_of = [&](const ObstacleField* obstacles) {
    double area = 0.0;
    for (const SurfaceSample& sample : ranking_samples(target, obstacles, options)) area += sample.area;
    return area;
  };
  const double all = area_of(nullptr);
  return all > 0.0 ? area_of(options.obstacles) / all : 1.0;
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
      "other faces lie in front of the target or upon it: a ball of radius {:.3g} mm that touches it enters them on "
      "{:.1f} % "
      "of its area; a smaller ball may reach it, and faces that are no obstacles can be ignored",
      reach_radius(options), 100.0 * (1.0 - share));
}

}  // namespace flank::internal
