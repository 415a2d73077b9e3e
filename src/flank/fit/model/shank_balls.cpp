#include "flank/fit/model/shank_balls.h"

#include <algorithm>
#include <cmath>

namespace flank::internal {
namespace {

constexpr double kApart = 1.0 / 3.0;  // of the shank's radius, at most

double shank_radius(const RadialFunction& tool, const RadiusBounds& bounds) {
  return bounds.shank_radius > 0.0 ? bounds.shank_radius : tool.at(tool.axis_length()).r;
}

}  // namespace

double shank_ball(const RadialFunction& tool, const RadiusBounds& bounds) {
  return kShankGrown * shank_radius(tool, bounds);
}

std::vector<double> shank_places(const RadialFunction& tool, const RadiusBounds& bounds) {
  constexpr int kMost = 200;
  if (!bounds.shank_in_the_way || bounds.shank_length <= 0.0) return {};
  const double needed = std::ceil(bounds.shank_length / (kApart * shank_radius(tool, bounds)));
  const int count = needed >= 1.0 && needed <= kMost ? static_cast<int>(needed) : kMost;
  std::vector<double> places;
  for (int k = 1; k <= count; ++k) places.push_back(tool.axis_length() + bounds.shank_length * k / count);
  return places;
}

}  // namespace flank::internal
