/// One piece of a path between two poses, and the smooth function that the judge minimises on it.
#pragma once

#include <cmath>

#include "flank/radial_function.h"
#include "flank/vec.h"
#include "flank/verify/swept/radial_table.h"

namespace flank::internal::verify {

/// Tip a0 + tau da and axis (w0 + tau dw) normalised, tau in [0, 1]: how the controller joins two poses (path/path.h).
struct Segment {
  Vec3 a0 = Vec3::Zero(), da = Vec3::Zero(), w0 = Vec3::UnitZ(), dw = Vec3::Zero();
  int strip = 0;  ///< 0-based
  int pose = 0;   ///< index of the first pose in its strip

  /// The pose at tau; the axis vector must not vanish between (pose_tree.h refuses such steps).
  [[nodiscard]] Pose at(double tau) const { return {a0 + tau * da, (w0 + tau * dw).normalized()}; }
};

/// F(tau, s) = |x - R(tau, s)| - r(s) with its first and second derivatives.
struct DistanceJet {
  double f = 0.0, distance = 0.0;  ///< mm; distance = |x - R(tau, s)|
  /// Derivatives by tau (t here) and s: mm, none, mm, none, 1/mm.
  double dt = 0.0, ds = 0.0, dtt = 0.0, dts = 0.0, dss = 0.0;
};

/// F at (tau, s); the point must not lie on the axis itself (distance > 0).
[[nodiscard]] inline DistanceJet distance_jet(const Segment& g, const RadialTable& radial, const Vec3& x, double tau,
                                              double s) {
  const Vec3 w = g.w0 + tau * g.dw;
  const double m = 1.0 / w.norm();
  const Vec3 u = w * m;
  // u' and u'' of u = w / |w| with w linear in tau.
  const double along = u.dot(g.dw);
  const Vec3 u1 = (g.dw - along * u) * m;
  const Vec3 u2 = -(2.0 * along * m) * u1 - u1.squaredNorm() * u;
  // R' and x - R; then F' and F'' by the chain rule, with n = (x - R) / |x - R|.
  const Vec3 v = g.da + s * u1;
  const Vec3 d = x - g.a0 - tau * g.da - s * u;
  const RadialJet j = radial.at(s);
  DistanceJet out;
  out.distance = d.norm();
  const double inverse = 1.0 / out.distance;
  const Vec3 n = d * inverse;
  const double nv = n.dot(v), nu = n.dot(u);
  out.f = out.distance - j.r;
  out.dt = -nv;
  out.ds = -nu - j.d1;
  out.dtt = (v.squaredNorm() - nv * nv) * inverse - s * n.dot(u2);
  out.dts = (v.dot(u) - nv * nu) * inverse - n.dot(u1);
  out.dss = (1.0 - nu * nu) * inverse - j.d2;
  return out;
}

/// F alone.
[[nodiscard]] inline double distance_value(const Segment& g, const RadialTable& radial, const Vec3& x, double tau,
                                           double s) {
  const Vec3 w = g.w0 + tau * g.dw;
  return (x - g.a0 - tau * g.da - (s / w.norm()) * w).norm() - radial.at(s).r;
}

/// Where the tool's plane through x and the axis of the pose has x: z along the axis from the tip, rho from the axis.
struct PlanePoint {
  double z = 0.0, rho = 0.0;
};
[[nodiscard]] inline PlanePoint plane_point(const Vec3& tip, const Vec3& axis, const Vec3& x) {
  const Vec3 d = x - tip;
  const double z = d.dot(axis);
  return {z, (d - z * axis).norm()};
}

}  // namespace flank::internal::verify
