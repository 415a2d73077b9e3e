#include "flank/tour/straight_flank.h"

#include <cmath>

namespace flank::internal {

double StraightFlank::axis_over(double line_mm) const { return line_mm / std::sqrt(1.0 - slope * slope); }

std::optional<StraightFlank> straight_flank(const RadialFunction& tool) {
  constexpr double kStraightMm = 1e-6;
  constexpr int kPlaces = 9;
  const double length = tool.axis_length();
  const double first = tool.at(0.0).r;
  const StraightFlank flank{first, (tool.at(length).r - first) / length};
  if (!(flank.radius > 0.0) || !(flank.at(length) > 0.0) || !(std::abs(flank.slope) < 1.0)) return {};
  for (int k = 1; k < kPlaces; ++k) {
    const double s = length * k / kPlaces;
    if (!(std::abs(tool.at(s).r - flank.at(s)) <= kStraightMm)) return {};
  }
  return flank;
}

Pose laid_against(const WallLine& line, const StraightFlank& flank, double foot_s) {
  const double head_s = foot_s + flank.axis_over(line.length());
  const Vec3 over_foot = line.foot + flank.at(foot_s) * line.foot_normal;
  const Vec3 over_head = line.head + flank.at(head_s) * line.head_normal;
  const Vec3 axis = (over_head - over_foot).normalized();
  return {over_foot - foot_s * axis, axis};
}

}  // namespace flank::internal
