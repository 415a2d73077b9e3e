#include "flank/wheel/point/motion_guard.h"

#include <algorithm>
#include <cmath>

namespace flank::internal {
namespace {

constexpr double kFinestMm = 0.01;  ///< sides of cells that still decide nothing: what is found there counts as a cut
constexpr double kStepMm = 0.2;     ///< along the axis of one pose

double angle_of(const Vec3& a, const Vec3& b) { return 2.0 * std::atan2((a - b).norm(), (a + b).norm()); }

}  // namespace

struct MotionGuard::Motion {
  const Pose &from, &to;
  double angle;
  [[nodiscard]] Vec3 at(double s, double t) const {
    const Vec3 axis = ((1.0 - t) * from.axis + t * to.axis).normalized();
    return (1.0 - t) * from.tip + t * to.tip + s * axis;
  }
};

/// `gaps`: distances to the triangles at (s0, t0), (s1, t0), (s0, t1), (s1, t1), mm.
struct MotionGuard::Cell {
  double s0, s1, t0, t1;
  std::array<double, 4> gaps;
};

MotionGuard::MotionGuard(const TriangleBvh& triangles, double off_mm, const RadialFunction& radial, double most_mm)
    : triangles_(triangles), radial_(radial), off_mm_(off_mm), most_mm_(most_mm) {}

double MotionGuard::corner(const Motion& motion, double s, double t) const {
  return std::sqrt(triangles_.closest(motion.at(s, t)).squared_distance);
}

bool MotionGuard::is_free(const Pose& from, const Pose& to) const {
  const Motion motion{from, to, angle_of(from.axis, to.axis)};
  const double length = radial_.axis_length();
  const Cell whole{
      0.0,
      length,
      0.0,
      1.0,
      {corner(motion, 0.0, 0.0), corner(motion, length, 0.0), corner(motion, 0.0, 1.0), corner(motion, length, 1.0)}};
  return is_free(motion, whole);
}

bool MotionGuard::decides(const Motion& motion, const Cell& cell) const {
  const double ds = cell.s1 - cell.s0, dt = cell.t1 - cell.t0;
  const double across = std::max((motion.at(cell.s0, cell.t1) - motion.at(cell.s0, cell.t0)).squaredNorm(),
                                 (motion.at(cell.s1, cell.t1) - motion.at(cell.s1, cell.t0)).squaredNorm());
  // Between corners p is beside the mean of them by the sagitta of the axis' turn.
  const double bulge = cell.s1 * motion.angle * motion.angle * dt * dt / 8.0 + off_mm_;
  double least = 1e300, dent = 0.0;
  for (const double s : {cell.s0, 0.5 * (cell.s0 + cell.s1), cell.s1}) {
    const RadialJet jet = radial_.at(s);
    dent = std::max(dent, -2.0 * (jet.d1 * jet.d1 + (jet.r - most_mm_) * jet.d2) * ds * ds / 8.0);
  }
  for (std::size_t k = 0; k < 4; ++k) {
    const double gap = std::max(0.0, cell.gaps[k] - bulge),
                 wanted = std::max(0.0, radial_.at(k % 2 == 0 ? cell.s0 : cell.s1).r - most_mm_);
    least = std::min(least, gap * gap - wanted * wanted);
  }
  return least >= 0.25 * (ds * ds + across) + dent;
}

bool MotionGuard::is_free(const Motion& motion, const Cell& cell) const {
  for (std::size_t k = 0; k < 4; ++k)
    if (cell.gaps[k] - off_mm_ < radial_.at(k % 2 == 0 ? cell.s0 : cell.s1).r - most_mm_) return false;
  if (decides(motion, cell)) return true;
  const double ds = cell.s1 - cell.s0;
  const double across = std::max((motion.at(cell.s0, cell.t1) - motion.at(cell.s0, cell.t0)).norm(),
                                 (motion.at(cell.s1, cell.t1) - motion.at(cell.s1, cell.t0)).norm());
  if (std::max(ds, across) < kFinestMm) return false;
  const std::array<double, 4>& g = cell.gaps;
  if (ds >= across) {
    const double s = 0.5 * (cell.s0 + cell.s1), low = corner(motion, s, cell.t0), high = corner(motion, s, cell.t1);
    return is_free(motion, {cell.s0, s, cell.t0, cell.t1, {g[0], low, g[2], high}}) &&
           is_free(motion, {s, cell.s1, cell.t0, cell.t1, {low, g[1], high, g[3]}});
  }
  const double t = 0.5 * (cell.t0 + cell.t1), low = corner(motion, cell.s0, t), high = corner(motion, cell.s1, t);
  return is_free(motion, {cell.s0, cell.s1, cell.t0, t, {g[0], g[1], low, high}}) &&
         is_free(motion, {cell.s0, cell.s1, t, cell.t1, {low, high, g[2], g[3]}});
}

MotionGuard::Depth MotionGuard::depth(const Pose& pose) const {
  Depth out;
  const double length = radial_.axis_length();
  for (double s = 0.0;;) {
    const Vec3 p = pose.at(s);
    const BvhHit hit = triangles_.closest(p);
    const double gap = std::sqrt(hit.squared_distance), mm = radial_.at(s).r - gap;
    if (mm > out.mm && gap > 0.0) out = {mm, (p - hit.point) / gap};
    if (s >= length) return out;
    s = std::min(length, s + std::max(kStepMm, -0.5 * mm));
  }
}

}  // namespace flank::internal
