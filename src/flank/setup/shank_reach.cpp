#include "flank/setup/shank_reach.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace flank::internal {
namespace {

/// Of the flank's diameter: by so much a standard shank may be thinner.
constexpr double kThinner = 0.1;

/// The way from a point along a unit vector until it has left a box for good, mm; 0 where it never comes into it.
double way_out(const Vec3& from, const Vec3& along, const Box3& box) {
  double in = 0.0, out = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const double low = box.low[k] - from[k], high = box.high[k] - from[k];
    if (std::abs(along[k]) < 1e-12) {
      if (low > 0.0 || high < 0.0) return 0.0;
      continue;
    }
    const double a = low / along[k], b = high / along[k];
    in = std::max(in, std::min(a, b));
    out = std::min(out, std::max(a, b));
  }
  return out > in ? out : 0.0;
}

}  // namespace

double shank_reach(const Tool& tool, const Path& path, const Box3& part, double radius_mm) {
  const double top = meridian_point(tool.radial, tool.radial.axis_length()).x();
  Box3 box = part;
  // A disc across the axis is inside of a ball of its radius.
  box.low -= Vec3::Constant(radius_mm);
  box.high += Vec3::Constant(radius_mm);
  double longest = 0.0;
  for (const Strip& strip : path.strips)
    for (const Pose& pose : strip.poses) longest = std::max(longest, way_out(pose.at(top), pose.axis, box));
  return longest;
}

const std::vector<double>& shank_diameters() {
  static const std::vector<double> kDiameters{3, 4, 5, 6, 8, 10, 12, 14, 16, 18, 20, 25, 32};
  return kDiameters;
}

std::optional<double> standard_shank(double flank_diameter_mm) {
  std::optional<double> found;
  for (const double diameter : shank_diameters())
    if (diameter <= flank_diameter_mm * (1.0 + 1e-9) && diameter >= (1.0 - kThinner) * flank_diameter_mm)
      found = diameter;
  return found;
}

std::string chosen_shank_text(const Tool& tool, const ObstacleRequest& chosen) {
  return fmt::format("the shank was chosen: diameter {:.4g} mm, {:g} mm above the flank, where it is out of the part",
                     tool.shank.empty() ? 0.0 : 2.0 * tool.shank.back().y(), chosen.shank_length_mm.value_or(0.0));
}

void choose_shank(const Tool& tool, const Path& path, const Box3& part, ObstacleRequest& request) {
  const double end = meridian_point(tool.radial, tool.radial.axis_length()).y();
  if (!request.shank_radius_mm)
    if (const std::optional<double> diameter = standard_shank(2.0 * end)) request.shank_radius_mm = 0.5 * *diameter;
  const double needed = std::ceil(shank_reach(tool, path, part, request.shank_radius_mm.value_or(end)));
  request.shank_length_mm = std::max(std::max(1.0, needed), request.shank_length_mm.value_or(0.0));
}

}  // namespace flank::internal
