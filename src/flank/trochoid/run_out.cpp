#include "flank/trochoid/run_out.h"

#include <algorithm>
#include <limits>

namespace flank::internal {
namespace {

/// Mean direction of both ways over their last quarter at an end, along x, across the axis.
Vec3 common_direction(const SidePath& a, const SidePath& b, bool end) {
  constexpr double kShare = 0.25;  // the last velocities of a fitted motion alone may be off
  const double middle = 0.5 * a.axis_length();
  Vec3 sum = Vec3::Zero(), up = Vec3::Zero();
  for (const SidePath* path : {&a, &b}) {
    const double x = end ? path->length() : 0.0, inner = end ? (1.0 - kShare) * x : kShare * path->length();
    const AxisPlace outer = path->at(x);
    const Vec3 way = outer.at(middle) - path->at(inner).at(middle);
    sum += (end ? way : Vec3(-way)).normalized();
    up += outer.u;
  }
  up.normalize();
  return (sum - sum.dot(up) * up).normalized();
}

/// How both paths leave one end.
struct Bend {
  Vec3 direction;
  double over_mm = 1.0;
};

void lay(SidePath& a, SidePath& b, bool end, const Bend& bend) {
  a.bend_run_out(end, bend.direction, bend.over_mm);
  b.bend_run_out(end, bend.direction, bend.over_mm);
}

/// Deepest that a run-out enters a face, mm: up to where cycles begin and end.
double entered(const SidePath& path, bool end, double radius, const HalfGuard& guard) {
  constexpr double kFarthest = 6.0, kStep = 0.4;  // radii
  constexpr int kPlaces = 7;
  GuardDepth depth;
  for (double by = kStep; by <= kFarthest; by += kStep) {
    const AxisPlace place = path.at(end ? path.length() + by * radius : -by * radius);
    guard.look({place.tip, place.u}, kPlaces, depth);
  }
  return depth.deepest();
}

double entered_at_end(const SidePath& path, bool end, const HalfGuard& guard) {
  constexpr int kPlaces = 7;
  GuardDepth depth;
  const AxisPlace place = path.at(end ? path.length() : 0.0);
  guard.look({place.tip, place.u}, kPlaces, depth);
  return depth.deepest();
}

}  // namespace

void join_run_outs(SidePath& a, SidePath& b, double radius_mm) {
  for (const bool end : {false, true}) lay(a, b, end, {common_direction(a, b, end), radius_mm});
}

void join_run_outs(SidePath& a, SidePath& b, double radius_mm, const HalfGuard& guard, double allowed_mm) {
  constexpr double kMore = 1.1;  // deeper than at the end by this share counts as deeper
  for (const bool end : {false, true}) {
    const Vec3 common = common_direction(a, b, end);
    const Vec3 up = (a.at(end ? a.length() : 0.0).u + b.at(end ? b.length() : 0.0).u).normalized();
    const double most_a = std::max(allowed_mm, kMore * entered_at_end(a, end, guard));
    const double most_b = std::max(allowed_mm, kMore * entered_at_end(b, end, guard));
    Bend best;
    double least = std::numeric_limits<double>::infinity();
    for (const double rise : {0.0, 0.12, 0.25, 0.45, 0.7, 1.0}) {
      for (const double over : {1.0, 2.0, 4.0}) {
        // Directions are along x: before the start the way up is that down.
        const Bend bend{(common + (end ? rise : -rise) * up).normalized(), over * radius_mm};
        lay(a, b, end, bend);
        const double deep =
            std::max(entered(a, end, radius_mm, guard) - most_a, entered(b, end, radius_mm, guard) - most_b);
        if (deep >= least) continue;
        least = deep;
        best = bend;
        if (least <= 0.0) break;
      }
      if (least <= 0.0) break;
    }
    lay(a, b, end, best);
  }
}

}  // namespace flank::internal
