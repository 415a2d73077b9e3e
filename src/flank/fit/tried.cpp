#include "flank/fit/tried.h"

#include <algorithm>
#include <limits>

#include "flank/fit/rank.h"
#include "flank/tool.h"

namespace flank::internal {

double slenderness_of(const RadialFunction& radial, const RadiusBounds& bounds) {
  Tool tool;
  tool.radial = radial;
  if (!radial.parameters().allFinite()) return std::numeric_limits<double>::infinity();
  const double length = radial.axis_length();
  if (bounds.shank_length > 0.0) {
    const double radius = bounds.shank_radius > 0.0 ? bounds.shank_radius : radial.at(length).r;
    tool.shank = {{length, radius}, {length + bounds.shank_length, radius}};
  }
  return stiffness(tool).slenderness;
}

TriedTool tried_tool(const RadialFunction& radial, std::size_t strips, const CoverageEstimate& estimate,
                     const RadiusBounds& bounds) {
  constexpr int kPlaces = 100;
  TriedTool tried;
  tried.slenderness = slenderness_of(radial, bounds);
  tried.axis_length_mm = radial.axis_length();
  for (int j = 0; j <= kPlaces; ++j)
    tried.largest_radius_mm = std::max(tried.largest_radius_mm, radial.at(radial.axis_length() * j / kPlaces).r);
  tried.strips = static_cast<int>(strips);
  tried.estimate = estimate;
  return tried;
}

void add_tried(FlankFitResult& chosen, const FlankFitResult& beaten, const RadiusBounds& bounds) {
  chosen.tried.insert(chosen.tried.end(), beaten.tried.begin(), beaten.tried.end());
  if (!beaten.motions.empty())
    chosen.tried.push_back(tried_tool(beaten.tool, beaten.motions.size(), beaten.after, bounds));
}

void tell_found(const Progress& progress, const CoverageEstimate& estimate, double tolerance_mm) {
  if (!progress.found) return;
  progress.found(
      {estimate.at_tolerance, std::max(estimate.overcut_mm, estimate.gouge_mm), is_clean(estimate, tolerance_mm)});
}

}  // namespace flank::internal
