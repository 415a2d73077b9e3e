#include "flank/fit/rejected.h"

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
    const double radius = bounds.shank_radius > 0.0 ? bounds.shank_radius : meridian_point(radial, length).y();
    tool.shank = {{length, radius}, {length + bounds.shank_length, radius}};
  }
  return stiffness(tool).slenderness;
}

RejectedTool rejected_tool(const RadialFunction& radial, std::size_t strips, const CoverageEstimate& estimate,
                           const RadiusBounds& bounds) {
  constexpr int kPlaces = 100;
  RejectedTool rejected;
  rejected.slenderness = slenderness_of(radial, bounds);
  rejected.axis_length_mm = radial.axis_length();
  for (int j = 0; j <= kPlaces; ++j)
    rejected.largest_radius_mm = std::max(rejected.largest_radius_mm, radial.at(radial.axis_length() * j / kPlaces).r);
  rejected.strips = static_cast<int>(strips);
  rejected.estimate = estimate;
  return rejected;
}

void add_rejected(FlankFitResult& chosen, const FlankFitResult& beaten, const RadiusBounds& bounds) {
  chosen.rejected.insert(chosen.rejected.end(), beaten.rejected.begin(), beaten.rejected.end());
  if (!beaten.motions.empty())
    chosen.rejected.push_back(rejected_tool(beaten.tool, beaten.motions.size(), beaten.after, bounds));
}

void tell_found(const Progress& progress, const CoverageEstimate& estimate, double tolerance_mm) {
  if (!progress.found) return;
  progress.found(
      {estimate.at_tolerance, std::max(estimate.overcut_mm, estimate.gouge_mm), is_clean(estimate, tolerance_mm)});
}

}  // namespace flank::internal
