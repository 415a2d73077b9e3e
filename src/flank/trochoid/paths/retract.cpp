#include "flank/trochoid/paths/retract.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace flank::internal {
namespace {

/// Least rise of a way per mm: a flatter one would run along the cavity.
constexpr double kLeastRise = 0.2;
/// So many ways go up at once.
constexpr std::size_t kStraight = 3;

Pose moved(const Pose& pose, const Vec3& by) { return {pose.tip + by, pose.axis}; }

/// `way` extended upwards along `direction` to the plane.
std::vector<Pose> rise(std::vector<Pose> way, const Vec3& direction, const ClearPlane& clear) {
  const double missing = clear.height - clear.top.dot(way.back().tip);
  if (missing > 0.0) way.push_back(moved(way.back(), missing / clear.top.dot(direction) * direction));
  return way;
}

/// Up along the axis, the way, and down again.
std::vector<Pose> raised(const std::vector<Pose>& way, double by_mm) {
  std::vector<Pose> out{way.front()};
  for (const Pose& pose : way) out.push_back(moved(pose, by_mm * pose.axis));
  out.push_back(way.back());
  return out;
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

std::vector<Pose> retract(const Pose& from, const WayOut& beside, const ClearPlane& clear, const RadialFunction& radial,
                          const HalfGuard& guard, double allowed_mm) {
  // Outward, until all of a leaning axis is beyond where its tip was.
  const Vec3 out = beside.outward.normalized();  // zero stays zero
  const double lean = std::max(0.0, -out.dot(from.axis)) * radial.axis_length() + 2.0 * radial.largest();
  const std::array<std::pair<Vec3, Vec3>, 7> ways = {{{Vec3::Zero(), from.axis},
                                                      {Vec3::Zero(), clear.top},
                                                      {Vec3::Zero(), (from.axis + clear.top).normalized()},
                                                      {lean * out, from.axis},
                                                      {lean * out, clear.top},
                                                      {beside.aside, from.axis},
                                                      {beside.aside, clear.top}}};
  std::vector<Pose> best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < ways.size(); ++k) {
    const auto& [over, direction] = ways[k];
    if (clear.top.dot(direction) < kLeastRise || (k >= kStraight && over.isZero())) continue;
    std::vector<Pose> way{from};
    if (k >= kStraight) way.push_back(moved(from, over));
    way = rise(std::move(way), direction, clear);
    const double depth = entered(way, radial, guard);
    if (depth < least) least = depth, best = std::move(way);
    if (least <= allowed_mm) break;
  }
  return best;
}

std::vector<Pose> off_floor(std::vector<Pose> way, const RadialFunction& radial, const HalfGuard& guard,
                            double allowed_mm) {
  /// The floor may rise along the axis less than it does across it: more than what is entered.
  constexpr double kMore = 1.6;
  constexpr int kTries = 4;
  std::vector<Pose> best = way;
  double least = entered(way, radial, guard), by = 0.0;
  for (int k = 0; k < kTries && least > allowed_mm; ++k) {
    by += kMore * least;
    std::vector<Pose> higher = raised(way, by);
    const double deep = entered(higher, radial, guard);
    if (deep >= least) break;
    least = deep, best = std::move(higher);
  }
  return best;
}

std::vector<Pose> poses_between(const Pose& from, const Pose& to, double axis_length, double largest_turn_rad) {
  const double middle = 0.5 * axis_length, turn = std::acos(std::clamp(from.axis.dot(to.axis), -1.0, 1.0));
  const int steps = std::max(1, static_cast<int>(std::ceil(turn / largest_turn_rad)));
  std::vector<Pose> poses;
  for (int k = 0; k <= steps; ++k) {
    const double x = static_cast<double>(k) / steps;
    const Vec3 u = ((1.0 - x) * from.axis + x * to.axis).normalized();
    const Vec3 at = (1.0 - x) * from.at(middle) + x * to.at(middle);
    poses.push_back({at - middle * u, u});
  }
  return poses;
}

}  // namespace flank::internal
