/// Convex bodies by what they reach in a direction, and the distance of two of them.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>

#include "flank/vec.h"

namespace flank::internal {

/// A box along the axes, a cone's frustum (a cylinder where both radii are equal), or a triangle. Millimetres.
class ConvexShape {
 public:
  [[nodiscard]] static ConvexShape box(const Vec3& low, const Vec3& high);
  /// Between the discs round `from` and `to`, which differ.
  [[nodiscard]] static ConvexShape frustum(const Vec3& from, double from_radius, const Vec3& to, double to_radius);
  [[nodiscard]] static ConvexShape triangle(const Vec3& a, const Vec3& b, const Vec3& c);

  /// The point farthest along d, which need not be a unit vector.
  [[nodiscard]] Vec3 support(const Vec3& d) const;
  [[nodiscard]] Box3 bounds() const;
  /// A ball that holds the shape.
  [[nodiscard]] const Vec3& middle() const { return middle_; }
  [[nodiscard]] double reach() const { return reach_; }

 private:
  enum class Kind : std::uint8_t { kBox, kFrustum, kTriangle };
  ConvexShape(Kind kind, const Vec3& a, const Vec3& b, const Vec3& c, const std::array<double, 2>& radii);

  Kind kind_;
  Vec3 a_, b_, c_;  ///< corners; of a box the lower and the upper, of a frustum the discs' centres and its direction
  std::array<double, 2> radii_;
  Vec3 middle_;
  double reach_ = 0.0;
};

/// By how much the true distance may be larger than what gap() says, mm.
inline constexpr double kGapErrorMm = 1e-3;

/// Distance of two shapes, mm, from below: never more than it is, and less by kGapErrorMm at most; 0 where they meet.
/// `to_first` takes the second one into the frame of the first. Beyond `enough` any bound that is larger will do.
[[nodiscard]] double gap(const ConvexShape& first, const ConvexShape& second, const Eigen::Isometry3d& to_first,
                         double enough);

}  // namespace flank::internal
