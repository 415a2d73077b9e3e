#include "flank/pipeline/search/search_setup.h"

#include <algorithm>
#include <cmath>

#include "flank/base/parallel.h"
#include "flank/base/tolerance_budget.h"
#include "flank/setup/make_obstacles.h"
#include "flank/setup/radius_default.h"

namespace flank::internal {
namespace {

/// The share of places of the target at which a ball of this radius touches it and none of the faces comes into the ball,
/// whichever side of them is material.
double room_for(double radius_mm, const Obstacles& obstacles, const Target& target) {
  constexpr double kPlaces = 150.0, kRounding = 0.999;
  const std::vector<SurfaceSample> places = target.samples(std::sqrt(target.area() / kPlaces));
  std::vector<char> open(places.size());
  parallel_for(places.size(), [&](std::size_t k) {
    const Vec3 centre = places[k].point + radius_mm * places[k].normal;
    open[k] = std::none_of(obstacles.faces.begin(), obstacles.faces.end(), [&](const ObstacleFace& face) {
      return face.surface->closest_within(centre, kRounding * radius_mm).patch >= 0;
    });
  });
  return static_cast<double>(std::count(open.begin(), open.end(), 1)) /
         static_cast<double>(std::max<std::size_t>(1, open.size()));
}

/// How high above the target the side of the other faces is judged, mm: by about a small tool's radius, lower in a slot, or
/// the voters would stand behind its far wall.
double voter_height(const Obstacles& obstacles, const Target& target, double largest_radius) {
  constexpr double kUsual = 0.5;  // of the largest radius
  constexpr double kSlot = 0.1, kMostly = 0.5, kStep = 0.8, kLeast = 0.02;
  const double usual = kUsual * largest_radius;
  if (room_for(usual, obstacles, target) >= kSlot) return usual;
  for (double height = kStep * usual; height > kLeast * usual; height *= kStep)
    if (room_for(height, obstacles, target) >= kMostly) return height;
  return usual;
}

}  // namespace

RadiusBounds radius_bounds(const RadiusRequest& radius, const ObstacleRequest& obstacles, double diagonal) {
  RadiusBounds bounds;
  bounds.largest = radius.max_mm.value_or(std::max(0.15 * diagonal, 2.0 * radius.min_mm.value_or(0.0)));
  bounds.smallest = radius.min_mm.value_or(std::min(kSmallestRadiusShare * diagonal, 0.5 * bounds.largest));
  bounds.steepest = radius.slope_max;
  bounds.slenderest = radius.slenderness_max;
  bounds.neck = radius.profile == "any" ? 1.0 : radius.neck;
  bounds.wheel_radius = radius.wheel_radius_mm.value_or(0.0);
  bounds.shank_length = obstacles.shank_length_mm.value_or(0.0);
  bounds.shank_radius = obstacles.shank_radius_mm.value_or(0.0);
  return bounds;
}

void add_group_obstacles(const Setup& setup, const ObstacleRequest& request, const RadiusBounds& bounds,
                         std::vector<TargetGroup>& targets) {
  /// The flank lies within a diameter of its target, and the walls of a channel beyond it count.
  constexpr double kReach = 2.0;
  const double shank = bounds.shank_radius > 0.0 ? bounds.shank_radius : bounds.largest;
  for (TargetGroup& group : targets) {
    ObstacleChoice choice = choose_obstacles(group.indices, setup.targets, setup.checks);
    choice.fixtures = setup.fixtures;
    choice.clearance_mm = request.clearance_mm;
    choice.tolerance_mm = setup.tolerance_mm;
    choice.allowance_mm = setup.allowance_mm;
    ObstacleDetail detail;
    detail.faces_within_mm =
        std::max(kReach * bounds.largest, bounds.shank_in_the_way ? bounds.shank_length + shank : 0.0);
    const Obstacles obstacles = make_obstacles(setup.part, *group.target, choice, detail);
    if (!obstacles.faces.empty())
      group.obstacles = std::make_unique<ObstacleField>(obstacles, *group.target,
                                                        voter_height(obstacles, *group.target, bounds.largest),
                                                        kToleranceBudget.others.fit_allowance * setup.tolerance_mm);
  }
}

}  // namespace flank::internal
