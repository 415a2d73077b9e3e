#include "flank/io/tool/profile_arcs.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "flank/base/assert.h"
#include "flank/tool.h"

namespace flank::internal {
namespace {

/// Bulges below this are lines: an arc that turns by less leaves its chord by 1e-10 of its length.
constexpr double kStraight = 1e-10;
/// Of the tolerance: what a biarc may use, because it is measured at places.
constexpr double kMeasured = 0.9;

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Unit tangent of the meridian at s, towards the holder: across the normal (-r', sqrt(1 - r'^2)).
Vec2 tangent_at(const RadialFunction& radial, double s) {
  const double slope = radial.at(s).d1;
  return {std::sqrt(std::max(0.0, 1.0 - slope * slope)), slope};
}

/// The arc that leaves `from` along a unit tangent and ends at `to`.
ProfileArc arc_along(const Vec2& from, const Vec2& tangent, const Vec2& to) {
  const Vec2 chord = to - from;
  const double bulge = std::tan(0.5 * std::atan2(cross(tangent, chord), tangent.dot(chord)));
  return {from, to, std::abs(bulge) < kStraight ? 0.0 : bulge};
}

/// Two arcs with a common tangent where they meet, from one point and tangent to another, with equal lengths along both
/// tangents (Bolton 1975).
std::array<ProfileArc, 2> biarc(const Vec2& p, const Vec2& tp, const Vec2& q, const Vec2& tq) {
  const Vec2 v = q - p, t = tp + tq;
  const double a = 2.0 * (1.0 - tp.dot(tq)), b = 2.0 * v.dot(t), c = v.squaredNorm();
  // a d^2 + b d - c = 0, the positive root, without cancellation for tangents that are nearly parallel.
  const double d = 2.0 * c / (b + std::sqrt(std::max(0.0, b * b + 4.0 * a * c)));
  const Vec2 joint = 0.5 * (p + q + d * (tp - tq));
  ProfileArc back = arc_along(q, -tq, joint);
  return {arc_along(p, tp, joint), {joint, q, -back.bulge}};
}

/// The largest distance of the meridian between two places from the arcs that stand for it.
double error_of(const std::array<ProfileArc, 2>& arcs, const RadialFunction& radial, double from, double to) {
  constexpr int kPlaces = 24;
  double largest = 0.0;
  const Vec2 along = arcs[1].to - arcs[0].from;
  for (int k = 1; k < kPlaces; ++k) {
    const Vec2 p = meridian_point(radial, from + (to - from) * k / kPlaces);
    const bool first = (p - arcs[0].to).dot(along) < 0.0;
    largest = std::max(largest, distance_to(arcs[first ? 0 : 1], p));
  }
  return largest;
}

std::array<ProfileArc, 2> biarc_between(const RadialFunction& radial, double from, double to) {
  return biarc(meridian_point(radial, from), tangent_at(radial, from), meridian_point(radial, to),
               tangent_at(radial, to));
}

/// The place farthest up the axis to which one biarc from here is good enough.
double farthest(const RadialFunction& radial, double from, double tolerance_mm) {
  constexpr int kHalvings = 24;
  const double length = radial.axis_length();
  const auto good = [&](double to) {
    return error_of(biarc_between(radial, from, to), radial, from, to) <= kMeasured * tolerance_mm;
  };
  if (good(length)) return length;
  // A short stretch is always good; the error need not grow with the stretch, so the first bad one is looked for.
  double low = from, high = length;
  for (double step = length / 64.0; from + step < length; step *= 1.5) {
    if (!good(from + step)) {
      high = from + step;
      break;
    }
    low = from + step;
  }
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (low + high);
    (good(middle) ? low : high) = middle;
  }
  // Never nothing: a stretch this short is a point for any grinder.
  constexpr double kLeastShare = 1e-6;
  return std::max(low, std::min(length, from + kLeastShare * length));
}

}  // namespace

double distance_to(const ProfileArc& arc, const Vec2& point) {
  const Vec2 chord = arc.to - arc.from;
  const double length = chord.norm();
  if (length == 0.0) return (point - arc.from).norm();
  if (arc.bulge == 0.0) return std::abs(cross(chord, point - arc.from)) / length;
  // Radius and centre from the bulge: the sagitta is half of bulge times chord.
  const double radius = length * (1.0 + arc.bulge * arc.bulge) / (4.0 * std::abs(arc.bulge));
  const Vec2 left(-chord.y() / length, chord.x() / length);
  const double height = length * (1.0 - arc.bulge * arc.bulge) / (4.0 * arc.bulge);
  const Vec2 centre = 0.5 * (arc.from + arc.to) + height * left;
  return std::abs((point - centre).norm() - radius);
}

std::vector<ProfileArc> profile_arcs(const RadialFunction& radial, double tolerance_mm) {
  FLANK_ASSERT(tolerance_mm > 0.0);
  std::vector<ProfileArc> arcs;
  for (double from = 0.0; from < radial.axis_length();) {
    const double to = farthest(radial, from, tolerance_mm);
    for (const ProfileArc& arc : biarc_between(radial, from, to)) {
      const bool line = arc.bulge == 0.0 && !arcs.empty() && arcs.back().bulge == 0.0;
      if (line)
        arcs.back().to = arc.to;
      else
        arcs.push_back(arc);
    }
    from = to;
  }
  return arcs;
}

std::vector<Vec2> points_of(const ProfileArc& arc, double chord_mm) {
  FLANK_ASSERT(chord_mm > 0.0);
  std::vector<Vec2> points{arc.from};
  const Vec2 chord = arc.to - arc.from;
  const double length = chord.norm();
  if (arc.bulge == 0.0 || length == 0.0) return points;
  const double angle = 4.0 * std::atan(arc.bulge);
  const double radius = length * (1.0 + arc.bulge * arc.bulge) / (4.0 * std::abs(arc.bulge));
  const double step = 2.0 * std::acos(std::max(0.0, 1.0 - chord_mm / radius));
  constexpr double kMostPoints = 1e5;
  const int count = static_cast<int>(std::min(std::ceil(std::abs(angle) / std::max(step, 1e-9)), kMostPoints));
  const Vec2 centre = arc.from + 0.5 * chord +
                      length * (1.0 - arc.bulge * arc.bulge) / (4.0 * arc.bulge) * Vec2(-chord.y(), chord.x()) / length;
  const Vec2 ray = arc.from - centre;
  for (int k = 1; k < count; ++k) {
    const double turn = angle * k / count, c = std::cos(turn), s = std::sin(turn);
    points.push_back(centre + Vec2(c * ray.x() - s * ray.y(), s * ray.x() + c * ray.y()));
  }
  return points;
}

}  // namespace flank::internal
