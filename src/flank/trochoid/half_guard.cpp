#include "flank/trochoid/half_guard.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace flank::internal {

namespace {

/// Farthest that balls along the axis may be apart, of the largest radius: an edge between two of them goes unseen to a
/// depth of 3 % of the radius, and of 40 % where they are a diameter and a half apart.
constexpr double kApart = 0.5;

}  // namespace

HalfGuard::HalfGuard(GuardedFaces faces, const RadialFunction& radial)
    : faces_(std::move(faces)),
      radial_(radial),
      least_places_(static_cast<int>(std::ceil(radial.axis_length() / (kApart * radial.largest()))) + 1) {}

void HalfGuard::look(const Pose& pose, int places, GuardDepth& out) const {
  const double length = radial_.axis_length();
  places = std::max(places, least_places_);
  for (int j = 0; j < places; ++j) {
    const double s = length * j / (places - 1), r = radial_.at(s).r, horizon = 1.01 * r;
    const Vec3 p = pose.at(s);
    for (const Target* side : faces_.sides) {
      const Footpoint foot = side->closest_within(p, horizon);
      if (foot.patch < 0) continue;
      // Behind a border's tangent plane a point is not yet in the material.
      const double d = foot.location == Location::kInside ? foot.distance : std::abs(foot.distance);
      out.sides = std::max(out.sides, r - d);
    }
    for (const ObstacleField* field : faces_.others) {
      if (field == nullptr) continue;
      const ObstacleDistance d = field->at(p, horizon);
      if (d.face < 0) continue;
      out.others = std::max(out.others, r - d.distance_mm);
      if (j <= places / 2) out.tip = std::max(out.tip, r - d.distance_mm);
    }
  }
}

GuardDepth HalfGuard::depth(const RuledMotion& motion, int times, int places) const {
  // Densest at both ends, where a half leaves a side at a tangent: what it enters, it enters there, for a moment.
  const auto time = [&](double i) { return 0.5 - 0.5 * std::cos(std::numbers::pi * i / (times - 1)); };
  GuardDepth out;
  double deepest = 0.0;
  int at = -1;
  for (int i = 0; i < times; ++i) {
    GuardDepth here;
    look(motion.pose(time(i)), places, here);
    if (here.deepest() > deepest) deepest = here.deepest(), at = i;
    out.add(here);
  }
  if (at < 0) return out;
  // The deepest place lies between the samples (where a half turns back before a wall): once more around the deepest of them, and
  // where a parabola through the deepest three of those has its peak.
  constexpr int kCloser = 4;
  std::array<double, 2 * kCloser + 1> depths{};
  const auto closer = [&](double k) {
    GuardDepth here;
    look(motion.pose(time(std::clamp(at + k / kCloser, 0.0, times - 1.0))), 2 * places - 1, here);
    out.add(here);
    return here.deepest();
  };
  for (int k = -kCloser; k <= kCloser; ++k) depths[static_cast<std::size_t>(k + kCloser)] = closer(k);
  const auto peak = std::max_element(depths.begin() + 1, depths.end() - 1);
  const double before = *(peak - 1), after = *(peak + 1), bend = before - 2.0 * *peak + after;
  if (bend < 0.0 && *peak >= std::max(before, after))
    closer(static_cast<double>(peak - depths.begin()) - kCloser + 0.5 * (before - after) / bend);
  return out;
}

}  // namespace flank::internal
