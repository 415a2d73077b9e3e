#include "flank/trochoid/entry/entry_slot.h"

#include <algorithm>
#include <array>

namespace flank::internal {
namespace {

constexpr int kDegree = 3;

/// A clamped cubic of one span, whose control points are the values of its polar form.
template <class Polar>
BSplineCurve3 cubic(const Polar& polar) {
  BSplineCurve3 curve;
  curve.degree = kDegree;
  curve.knots = {0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0};
  curve.poles.resize(3, kDegree + 1);
  for (int k = 0; k <= kDegree; ++k) curve.poles.col(k) = polar(k);
  return curve;
}

/// Values at the three arguments of control point k: so many of them are those of the end.
std::array<double, 3> arguments(double start, double end, int k) {
  return {k > 2 ? end : start, k > 1 ? end : start, k > 0 ? end : start};
}

double mean(const std::array<double, 3>& x) { return (x[0] + x[1] + x[2]) / 3.0; }

/// Polar form of the product of two numbers that change evenly.
double product(const std::array<double, 3>& x, const std::array<double, 3>& y) {
  return (x[0] * (y[1] + y[2]) + x[1] * (y[0] + y[2]) + x[2] * (y[0] + y[1])) / 6.0;
}

}  // namespace

RuledMotion EntrySlot::move(const SlotPlace& a, const SlotPlace& b) const {
  const Vec3 way = to.tip - from.tip, turn = to.axis - from.axis;
  RuledMotion motion;
  motion.axis_length = axis_length;
  motion.tip = cubic([&](int k) {
    const auto g = arguments(a.along, b.along, k), h = arguments(a.height_mm, b.height_mm, k);
    return Vec3(from.tip + mean(g) * way + 4.0 * (mean(g) - product(g, g)) * bulge + mean(h) * from.axis +
                product(g, h) * turn);
  });
  motion.direction = cubic([&](int k) { return Vec3(from.axis + mean(arguments(a.along, b.along, k)) * turn); });
  return motion;
}

Pose EntrySlot::pose(const SlotPlace& place) const { return move(place, place).pose(0.0); }

double EntrySlot::least_way(double most_mm) const {
  // The bulge is taken as across the way: it makes it longer.
  const Vec3 way = to.tip - from.tip, turn = to.axis - from.axis;
  const double turn2 = turn.squaredNorm();
  const double height = turn2 > 0.0 ? std::clamp(-way.dot(turn) / turn2, 0.0, most_mm) : 0.0;
  return (way + height * turn).norm();
}

}  // namespace flank::internal
