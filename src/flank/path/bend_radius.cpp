#include "flank/path/bend_radius.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace flank::internal {
namespace {

/// The places of a point of the axis that lie apart.
std::vector<Vec3> places_of(const Strip& strip, double s, double still_mm) {
  std::vector<Vec3> places;
  for (const Pose& pose : strip.poses)
    if (const Vec3 here = pose.at(s); places.empty() || (here - places.back()).norm() > still_mm)
      places.push_back(here);
  return places;
}

double least_radius(const std::vector<Vec3>& places) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i + 1 < places.size(); ++i) {
    const Vec3 before = places[i] - places[i - 1], after = places[i + 1] - places[i];
    const double turn = std::atan2(before.cross(after).norm(), before.dot(after));
    if (turn > 0.0) least = std::min(least, 0.25 * (before.norm() + after.norm()) / std::tan(0.5 * turn));
  }
  return least;
}

}  // namespace

BendRadii least_bend_radii(const Path& path, double axis_length, double still_mm) {
  BendRadii least;
  for (const Strip& strip : path.strips) {
    least.tip_mm = std::min(least.tip_mm, least_radius(places_of(strip, 0.0, still_mm)));
    least.holder_end_mm = std::min(least.holder_end_mm, least_radius(places_of(strip, axis_length, still_mm)));
  }
  return least;
}

}  // namespace flank::internal
