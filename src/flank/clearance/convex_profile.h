/// A convex solid of revolution, posed: its signed distance with first and second derivatives, for the planner.
#pragma once

#include <vector>

#include "flank/geom/vec.h"

namespace flank {

/// Signed distance of a point to a posed body, negative inside, convex everywhere.
struct BodyJet {
  double value = 0.0;
  Vec3 gradient = Vec3::Zero();   ///< unit vector, away from the body
  Vec3 across = Vec3::Zero();     ///< unit vector from the axis to the point
  double z = 0.0, rho = 0.0;      ///< of the point: along the axis from s = 0, and from the axis
  double along = 0.0, out = 0.0;  ///< the gradient's parts along the axis and along `across`
  double corner = 0.0;            ///< 1 / distance where a rim of the body is nearest, else 0

  /// Second derivative along two directions: a rim curves by 1 / distance across the gradient in the plane of the axis,
  /// and going round the axis by out / rho.
  [[nodiscard]] double second(const Vec3& axis, const Vec3& a, const Vec3& b) const {
    const double az = axis.dot(a), ae = across.dot(a), bz = axis.dot(b), be = across.dot(b);
    const double round = rho > 0.0 ? out / rho : 0.0;
    return corner * (out * az - along * ae) * (out * bz - along * be) + round * (a.dot(b) - az * bz - ae * be);
  }
};

class ConvexProfile {
 public:
  /// Corners (z, r) from the lower to the upper end: z not falling, r >= 0, slopes not growing.
  explicit ConvexProfile(const std::vector<Vec2>& corners);

  [[nodiscard]] BodyJet at(const Pose& pose, const Vec3& x) const;

 private:
  /// Sides from the axis over the outside back to the axis, in arrays, for the compiler's sake.
  Eigen::ArrayXd normal_z_, normal_rho_, offset_;
  std::vector<Vec2> from_, along_;
  std::vector<double> length_;
};

/// A profile (z, radius) as convex ones.
[[nodiscard]] std::vector<ConvexProfile> split_convex(const std::vector<Vec2>& profile);

}  // namespace flank
