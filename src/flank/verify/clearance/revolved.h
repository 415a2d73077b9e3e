/// A convex solid of revolution in its own frame: the body that the judge measures clearances of.
#pragma once

#include <array>
#include <vector>

#include "flank/vec.h"

namespace flank::internal::verify {

/// Signed distance in the half plane (z, rho), rho >= 0, with what a descent needs to know of it.
struct ProfileDistance {
  double value = 0.0;           ///< negative inside
  double dz = 0.0, drho = 0.0;  ///< its gradient, a unit vector
  double corner = 0.0;  ///< 1 / distance where a corner is nearest, else 0: the second derivative across the gradient
};

/// The convex hull of circles of radius r_i about the z axis at z_i. Its signed distance is convex in space, outside
/// and inside: the largest over unit n of <n, x> - support(n).
class Revolved {
 public:
  /// Corners (z, r) with z not falling, r >= 0, whose slopes do not grow. At least one. All of it grows by `rounding`:
  /// a single corner on the axis makes a ball.
  explicit Revolved(std::vector<Vec2> corners, double rounding = 0.0);

  /// Signed distance of the point (z, rho), rho >= 0, mm, with its gradient. On edges of the inside, where two sides
  /// are equally near, one of the possible gradients.
  [[nodiscard]] ProfileDistance distance(double z, double rho) const;
  /// The same without the gradient.
  [[nodiscard]] double value(double z, double rho) const;
  /// At most `value`, and equal to it but where a corner is nearest: what is far is told by it in half the time.
  [[nodiscard]] double floor(double z, double rho) const;
  /// Outward normals of the two sides that face the point most, the first one most; its gradient twice where there are no two sides. Inside,
  /// the distance is not smooth where both are as near.
  [[nodiscard]] std::array<Vec2, 2> facing(double z, double rho) const;
  /// Corner (before the rounding) that is farthest in the direction that has `along` to the axis and `across` >= 0 from
  /// it.
  [[nodiscard]] const Vec2& support(double along, double across) const;
  [[nodiscard]] const std::vector<Vec2>& corners() const { return corners_; }  ///< before the rounding
  [[nodiscard]] double rounding() const { return rounding_; }                  ///< mm

 private:
  struct Side {
    Vec2 from, along, normal;  ///< unit vectors; the normal points outwards
    double length = 0.0;
  };
  std::vector<Vec2> corners_;
  double rounding_ = 0.0;
  std::vector<Side> sides_;  ///< from the axis over the lower end, the outside and the upper end back to the axis
};

/// Profile (z, radius), z not falling, radii >= 0, as convex bodies whose union is the solid that it turns. Empty for
/// fewer than two points.
[[nodiscard]] std::vector<Revolved> convex_bodies(const std::vector<Vec2>& profile);

}  // namespace flank::internal::verify
