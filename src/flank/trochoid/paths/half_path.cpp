#include "flank/trochoid/paths/half_path.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace flank::internal {
namespace {

constexpr int kPoles = 6, kDegree = 3;
/// Weight of the second derivatives against the first ones: a half circle of length l has |c'| = l and |c''| = pi l, so
/// both terms of it are alike.
constexpr double kFairness = 0.1;
/// Of the lift, for the control points that leave and arrive: along its own axis a tool goes on touching its side.
constexpr double kLiftAtEnds = 0.15;

using Gram = Eigen::Matrix<double, kPoles, kPoles>;

/// Integrals of kFairness B_i'' B_j'' + B_i' B_j' over [0, 1].
Gram energy() {
  constexpr std::array<double, 3> kNodes = {-0.7745966692414834, 0.0, 0.7745966692414834};
  constexpr std::array<double, 3> kWeights = {5.0 / 9.0, 8.0 / 9.0, 5.0 / 9.0};  // Gauss, exact up to degree 5
  const std::vector<double> knots = uniform_knots(kDegree, kPoles);
  Gram gram = Gram::Zero();
  constexpr int kSpans = kPoles - kDegree;
  for (int span = 0; span < kSpans; ++span) {
    for (int k = 0; k < 3; ++k) {
      const double t = (span + 0.5 + 0.5 * kNodes[static_cast<std::size_t>(k)]) / kSpans;
      const double weight = 0.5 * kWeights[static_cast<std::size_t>(k)] / kSpans;
      std::array<double, 3 * (kDegree + 1)> b{};
      basis_derivatives(kDegree, knots, span + kDegree, t, 2, b.data());
      for (int i = 0; i <= kDegree; ++i)
        for (int j = 0; j <= kDegree; ++j)
          gram(span + i, span + j) +=
              weight * (kFairness * b[static_cast<std::size_t>(8 + i)] * b[static_cast<std::size_t>(8 + j)] +
                        b[static_cast<std::size_t>(4 + i)] * b[static_cast<std::size_t>(4 + j)]);
    }
  }
  return gram;
}

/// Control points 2 and 3 as combinations of 0, 1, 4 and 5.
Eigen::Matrix<double, 2, 4> inner_of_outer() {
  const Gram gram = energy();
  const Eigen::Matrix2d inner = gram.block<2, 2>(2, 2);
  Eigen::Matrix<double, 2, 4> outer;
  outer << gram.block<2, 2>(2, 0), gram.block<2, 2>(2, 4);
  return -inner.inverse() * outer;
}

BSplineCurve3 rail(const Vec3& from, const Vec3& leave, const Vec3& arrive, const Vec3& to, const Vec3& shift) {
  static const Eigen::Matrix<double, 2, 4> kInner = inner_of_outer();
  static const std::vector<double> kKnots = uniform_knots(kDegree, kPoles);
  Eigen::Matrix<double, 3, 4> outer;
  outer << from, leave, arrive, to;
  BSplineCurve3 curve;
  curve.degree = kDegree;
  curve.knots = kKnots;
  curve.poles.resize(3, kPoles);
  curve.poles.leftCols<2>() = outer.leftCols<2>();
  curve.poles.rightCols<2>() = outer.rightCols<2>();
  curve.poles.middleCols<2>(2) = (outer * kInner.transpose()).colwise() + shift;
  return curve;
}

}  // namespace

RuledMotion half_path(double axis_length, const AxisPlace& from, const AxisPlace& to, const HalfShape& shape) {
  const double middle = 0.5 * axis_length;
  const Vec3 forward = (from.velocity(middle) - to.velocity(middle)).normalized();
  const Vec3 up = (from.u + to.u).normalized();
  const Vec3 shift = shape.bulge_mm * forward + shape.lift_mm * up;
  const double rise = kLiftAtEnds * shape.lift_mm;
  const Vec3 leave = from.tip + shape.leave_mm * from.tip_dx + rise * from.u;
  const Vec3 arrive = to.tip - shape.arrive_mm * to.tip_dx + rise * to.u;
  RuledMotion motion;
  motion.axis_length = axis_length;
  motion.tip = rail(from.tip, leave, arrive, to.tip, shift);
  motion.direction =
      rail(from.u, from.u + shape.leave_mm * from.u_dx, to.u - shape.arrive_mm * to.u_dx, to.u, Vec3::Zero());
  return motion;
}

double reach_ahead(const RuledMotion& half, const AxisPlace& from, const AxisPlace& to) {
  constexpr int kSteps = 24;
  const double middle = 0.5 * half.axis_length;
  const Vec3 start = from.at(middle), across = (to.at(middle) - start).normalized();
  const Vec3 leave = from.velocity(middle) - to.velocity(middle);
  const Vec3 ahead = (leave - leave.dot(across) * across).normalized();
  double reach = 0.0;
  for (int i = 1; i < kSteps; ++i)
    reach = std::max(reach, (half.pose(static_cast<double>(i) / kSteps).at(middle) - start).dot(ahead));
  return reach;
}

RuledMotion half_path_across(double axis_length, const AxisPlace& from, const AxisPlace& to, const HalfShape& shape,
                             double share_from, double share_to) {
  const double gap = (to.at(0.5 * axis_length) - from.at(0.5 * axis_length)).norm();
  const auto turned = [&](const AxisPlace& place, double kept) -> AxisPlace {
    const double across = gap > 0.0 ? std::sqrt(std::max(0.0, 1.0 - kept * kept)) / gap : 0.0;
    return {place.tip, place.u, kept * place.tip_dx + across * (to.tip - from.tip),
            kept * place.u_dx + across * (to.u - from.u)};
  };
  HalfShape less = shape;
  less.bulge_mm *= std::min(share_from, share_to);
  return half_path(axis_length, turned(from, share_from), turned(to, share_to), less);
}

RuledMotion half_path_round(double axis_length, const AxisPlace& from, const AxisPlace& to, double lift_mm,
                            double corner_from, double corner_to) {
  // Of a corner's radius: how far its control points are ahead of the end, and across. The first spans then turn by a right angle
  // about as evenly as a quarter of a circle, and reach as far ahead as the radius.
  constexpr std::array<double, 3> kAhead = {0.45, 0.95, 1.0}, kAcross = {0.0, 0.35, 1.3};
  constexpr int kRoundPoles = 9, kEnd = kRoundPoles - 1;
  const double gap = (to.at(0.5 * axis_length) - from.at(0.5 * axis_length)).norm();
  const double per_mm = gap > 0.0 ? 1.0 / gap : 0.0;
  const Vec3 up = lift_mm * (from.u + to.u).normalized();
  RuledMotion motion;
  motion.axis_length = axis_length;
  for (BSplineCurve3* rail : {&motion.tip, &motion.direction}) {
    rail->degree = kDegree;
    rail->knots = uniform_knots(kDegree, kRoundPoles);
    rail->poles.resize(3, kRoundPoles);
  }
  const Vec3 across = per_mm * (to.tip - from.tip), turn = per_mm * (to.u - from.u);
  motion.tip.poles.col(0) = from.tip, motion.direction.poles.col(0) = from.u;
  motion.tip.poles.col(kEnd) = to.tip, motion.direction.poles.col(kEnd) = to.u;
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const Vec3 lift = k == 0 ? kLiftAtEnds * up : up;
    motion.tip.poles.col(1 + k) = from.tip + corner_from * (kAhead[i] * from.tip_dx + kAcross[i] * across) + lift;
    motion.tip.poles.col(kEnd - 1 - k) = to.tip - corner_to * (kAhead[i] * to.tip_dx + kAcross[i] * across) + lift;
    motion.direction.poles.col(1 + k) = from.u + corner_from * (kAhead[i] * from.u_dx + kAcross[i] * turn);
    motion.direction.poles.col(kEnd - 1 - k) = to.u - corner_to * (kAhead[i] * to.u_dx + kAcross[i] * turn);
  }
  for (BSplineCurve3* rail : {&motion.tip, &motion.direction})
    rail->poles.col(kRoundPoles / 2) =
        0.5 * (rail->poles.col(kRoundPoles / 2 - 1) + rail->poles.col(kRoundPoles / 2 + 1));
  return motion;
}

namespace {

/// reach_ahead, where that is farther than the room; else nothing.
std::optional<double> reach_beyond(const RuledMotion& half, const AxisPlace& from, const AxisPlace& to, double room) {
  if (!std::isfinite(room)) return std::nullopt;
  const double reach = reach_ahead(half, from, to);
  return reach > room ? std::optional(reach) : std::nullopt;
}

}  // namespace

RuledMotion half_off_wall(double axis_length, const AxisPlace& from, const AxisPlace& to, const HalfShape& shape,
                          double room_from, double room_to) {
  RuledMotion half = half_path(axis_length, from, to, shape);
  const std::optional<double> reach = reach_beyond(half, from, to, std::min(room_from, room_to));
  if (!reach) return half;
  return half_path_across(axis_length, from, to, shape, std::clamp(room_from / *reach, 0.0, 1.0),
                          std::clamp(room_to / *reach, 0.0, 1.0));
}

RuledMotion half_before_wall(double axis_length, const AxisPlace& from, const AxisPlace& to, const HalfShape& shape,
                             double room_from, double room_to) {
  RuledMotion half = half_path(axis_length, from, to, shape);
  const std::optional<double> reach = reach_beyond(half, from, to, std::min(room_from, room_to));
  if (!reach) return half;
  return half_path_round(axis_length, from, to, shape.lift_mm, std::min(room_from, *reach), std::min(room_to, *reach));
}

double way_of_middle(const RuledMotion& motion) {
  constexpr int kSteps = 24;
  double way = 0.0;
  Vec3 before = motion.pose(0.0).at(0.5 * motion.axis_length);
  for (int i = 1; i <= kSteps; ++i) {
    const Vec3 now = motion.pose(static_cast<double>(i) / kSteps).at(0.5 * motion.axis_length);
    way += (now - before).norm();
    before = now;
  }
  return way;
}

}  // namespace flank::internal
