#include "flank/trochoid/retract.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace flank::internal {
namespace {

/// Least rise of a way per mm: a flatter one would run along the cavity.
constexpr double kLeastRise = 0.2;

Pose moved(const Pose& pose, const Vec3& by) { return {pose.tip + by, pose.axis}; }

/// `way` extended upwards along `direction` to the plane.
std::vector<Pose> rise(std::vector<Pose> way, const Vec3& direction, const ClearPlane& clear) {
  const double missing = clear.height - clear.top.dot(way.back().tip);
  if (missing > 0.0) way.push_back(moved(way.back(), missing / clear.top.dot(direction) * direction));
  return way;
}

double entered(const std::vector<Pose>& way, const RadialFunction& radial, const HalfGuard& guard) {
  constexpr double kStep = 0.4;  // of the radius
  constexpr int kPlaces = 7;
  GuardDepth depth;
  for (std::size_t k = 1; k < way.size(); ++k) {
    const Vec3 by = way[k].tip - way[k - 1].tip;
    const int steps = std::max(1, static_cast<int>(std::ceil(by.norm() / (kStep * radial.largest()))));
    for (int i = 0; i <= steps; ++i) guard.look(moved(way[k - 1], static_cast<double>(i) / steps * by), kPlaces, depth);
  }
  return depth.deepest();
}

}  // namespace

std::vector<Pose> retract(const Pose& from, const Vec3& outward, const ClearPlane& clear, const RadialFunction& radial,
                          const HalfGuard& guard, double allowed_mm) {
  // Outward, until all of a leaning axis is beyond where its tip was.
  const Vec3 out = outward.normalized();  // zero stays zero
  const double lean = std::max(0.0, -out.dot(from.axis)) * radial.axis_length() + 2.0 * radial.largest();
  const std::array<std::pair<double, Vec3>, 5> ways = {{{0.0, from.axis},
                                                        {0.0, clear.top},
                                                        {0.0, (from.axis + clear.top).normalized()},
                                                        {lean, from.axis},
                                                        {lean, clear.top}}};
  std::vector<Pose> best;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [over, direction] : ways) {
    if (clear.top.dot(direction) < kLeastRise || (over > 0.0 && out.isZero())) continue;
    std::vector<Pose> way{from};
    if (over > 0.0) way.push_back(moved(from, over * out));
    way = rise(std::move(way), direction, clear);
    const double depth = entered(way, radial, guard);
    if (depth < least) least = depth, best = std::move(way);
    if (least <= allowed_mm) break;
  }
  return best;
}

}  // namespace flank::internal
