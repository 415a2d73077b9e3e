/// A convex solid of revolution, posed: its signed distance with first and second derivatives, for the planner.
#pragma once

#include <vector>

#include "flank/vec.h"

namespace flank::internal {

/// Signed distance in the half plane (z, rho), rho >= 0, of the tool's axis.
struct ProfileJet {
  double value = 0.0;
  double along = 0.0, out = 0.0;  ///< its gradient, a unit vector: along the axis and away from it
  double corner = 0.0;            ///< 1 / distance where a corner is nearest, else 0
};

/// Signed distance of a point to a posed body, negative inside, convex everywhere.
struct BodyJet : ProfileJet {
  Vec3 gradient = Vec3::Zero();  ///< unit vector, away from the body
  Vec3 across = Vec3::Zero();    ///< unit vector from the axis to the point
  double z = 0.0, rho = 0.0;     ///< of the point: along the axis from s = 0, and from the axis

  /// Second derivative along two directions: a rim curves by 1 / distance across the gradient in the plane of the axis,
  /// and going round the axis by out / rho.
  [[nodiscard]] double second(const Vec3& axis, const Vec3& a, const Vec3& b) const {
    const double az = axis.dot(a), ae = across.dot(a), bz = axis.dot(b), be = across.dot(b);
    const double round = rho > 0.0 ? out / rho : 0.0;
    return corner * (out * az - along * ae) * (out * bz - along * be) + round * (a.dot(b) - az * bz - ae * be);
  }
};

/// The outline of the body in the half plane. Immutable.
class ConvexProfile {
 public:
  /// Corners (z, r) from the lower to the upper end: z not falling, r >= 0, slopes not growing. The body grows by
  /// `rounding`; one corner on the axis makes a ball.
  explicit ConvexProfile(const std::vector<Vec2>& corners, double rounding = 0.0);

  /// Signed distance of (z, rho), rho >= 0. Walks from the side that faces the point: O(sides), no search structure,
  /// since bodies have a handful.
  [[nodiscard]] ProfileJet at(double z, double rho) const;

 private:
  /// A side of the outline, from the axis over the outside back to the axis.
  struct Side {
    double normal_z, normal_rho, offset;  ///< its line is normal . p = offset
    double start, length;  ///< (-normal_rho, normal_z) . p of its first end; the other direction is along
  };
  Vec2 first_;
  double rounding_ = 0.0;
  std::vector<Side> sides_;  ///< none: the body is a ball about first_
};

/// A profile (z, radius) as convex ones.
[[nodiscard]] std::vector<ConvexProfile> split_convex(const std::vector<Vec2>& profile);

/// Where a point is, seen from a pose.
struct PosedPoint {
  Vec3 perpendicular;
  double z = 0.0, rho = 0.0;

  PosedPoint(const Pose& pose, const Vec3& x) {
    const Vec3 d = x - pose.tip;
    z = d.dot(pose.axis);
    perpendicular = d - z * pose.axis;
    rho = perpendicular.norm();
  }
};

/// The distance of the point in space.
[[nodiscard]] BodyJet body_jet(const ConvexProfile& body, const Pose& pose, const Vec3& x);

}  // namespace flank::internal
