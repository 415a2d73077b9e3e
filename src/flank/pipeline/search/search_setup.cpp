#include "flank/pipeline/search/search_setup.h"

#include <algorithm>

#include "flank/base/tolerance_budget.h"
#include "flank/setup/make_obstacles.h"

namespace flank::internal {

RadiusBounds radius_bounds(const RadiusRequest& radius, const ObstacleRequest& obstacles, double diagonal) {
  RadiusBounds bounds;
  bounds.largest = radius.max_mm.value_or(std::max(0.15 * diagonal, 2.0 * radius.min_mm.value_or(0.0)));
  bounds.smallest = radius.min_mm.value_or(std::min(0.01 * diagonal, 0.5 * bounds.largest));
  bounds.steepest = radius.slope_max;
  bounds.slenderest = radius.slenderness_max;
  bounds.neck = radius.profile == "any" ? 1.0 : radius.neck;
  bounds.wheel_radius = radius.wheel_radius_mm.value_or(0.0);
  bounds.shank_length = obstacles.shank_length_mm.value_or(0.0);
  bounds.shank_radius = obstacles.shank_radius_mm.value_or(0.0);
  return bounds;
}

void add_group_obstacles(const Setup& setup, const std::optional<double>& clearance_mm, double largest_radius,
                         std::vector<TargetGroup>& targets, std::vector<std::string>& notes) {
  /// The flank lies within a diameter of its target, and the walls of a channel beyond it count.
  constexpr double kReach = 2.0;
  /// Above the target by about a small tool's radius.
  constexpr double kVoterHeight = 0.5;
  for (TargetGroup& group : targets) {
    ObstacleChoice choice = choose_obstacles(group.indices, setup.targets, setup.checks);
    choice.fixtures = setup.fixtures;
    choice.clearance_mm = clearance_mm;
    choice.tolerance_mm = setup.tolerance_mm;
    ObstacleDetail detail;
    detail.faces_within_mm = kReach * largest_radius;
    const Obstacles obstacles = make_obstacles(setup.part, *group.target, choice, detail, notes);
    if (!obstacles.faces.empty())
      group.obstacles = std::make_unique<ObstacleField>(obstacles, *group.target, kVoterHeight * largest_radius,
                                                        kToleranceBudget.others.fit_allowance * setup.tolerance_mm);
  }
}

}  // namespace flank::internal
