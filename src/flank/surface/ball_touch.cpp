#include "flank/surface/ball_touch.h"

#include <algorithm>

namespace flank::internal {

bool ball_touches(std::span<const Target* const> targets, const Vec3& centre, double radius_mm, double reach_mm) {
  return std::any_of(targets.begin(), targets.end(), [&](const Target* target) {
    const Footpoint foot = target->closest_within(centre, radius_mm + reach_mm);
    return foot.patch >= 0 && foot.location == Location::kInside;
  });
}

bool ball_fits(const Target& target, const SurfaceSample& sample, double radius_mm, double depth_mm) {
  return !target.is_nearer(sample.point + radius_mm * sample.normal, radius_mm - depth_mm);
}

}  // namespace flank::internal
