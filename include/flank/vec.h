/// Vectors, boxes and axis poses. Lengths in millimetres.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <limits>

namespace flank {

/// Plane: a parameter plane (u, v), or a tool profile (z, radius).
using Vec2 = Eigen::Vector2d;
/// Space: the frame of the part, mm.
using Vec3 = Eigen::Vector3d;

/// Axis-aligned box; empty until something is added.
struct Box3 {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 high = Vec3::Constant(-std::numeric_limits<double>::infinity());

  void add(const Vec3& p) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  void add(const Box3& b) {
    low = low.cwiseMin(b.low);
    high = high.cwiseMax(b.high);
  }
  [[nodiscard]] bool empty() const { return !(low.array() <= high.array()).all(); }
  /// Length of the diagonal, the "size" that relative errors are divided by; 0 if empty.
  [[nodiscard]] double diagonal() const { return empty() ? 0.0 : (high - low).norm(); }
  [[nodiscard]] Vec3 center() const { return 0.5 * (low + high); }
  /// Squared distance from p to the box, 0 inside.
  [[nodiscard]] double squared_distance(const Vec3& p) const {
    return (low - p).cwiseMax(p - high).cwiseMax(0.0).squaredNorm();
  }
};

/// A tool axis in the frame of the part: the axis point at s = 0 (tip) and the unit vector towards the holder.
struct Pose {
  Vec3 tip = Vec3::Zero();
  Vec3 axis = Vec3::UnitZ();
  [[nodiscard]] Vec3 at(double s) const { return tip + s * axis; }
};

}  // namespace flank
