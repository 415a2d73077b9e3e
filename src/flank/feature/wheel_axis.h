/// The axis of a wheel: the line that most of a part's surfaces of revolution turn about.
#pragma once

#include <optional>
#include <vector>

#include "flank/feature/wheel_face.h"

namespace flank::internal {

struct WheelAxis {
  Vec3 point = Vec3::Zero(), direction = Vec3::UnitZ();  ///< the point is the one nearest to the middle of the part
  double turned_mm2 = 0.0;                               ///< area of the faces of revolution about it

  [[nodiscard]] double along(const Vec3& p) const { return direction.dot(p - point); }
  [[nodiscard]] double radius(const Vec3& p) const { return (p - point - along(p) * direction).norm(); }
  /// Unit vector in the direction in which a right-handed turn moves p; zero on the axis.
  [[nodiscard]] Vec3 around(const Vec3& p) const {
    const Vec3 v = direction.cross(p - point);
    return v.norm() > 1e-12 ? v.normalized() : Vec3::Zero();
  }
  /// Radians from a fixed direction across the axis, from -pi to pi.
  [[nodiscard]] double angle(const Vec3& p) const;
  /// A turn about the axis by so many radians.
  [[nodiscard]] Eigen::Isometry3d turn(double radians) const;
};

/// Is it a surface of revolution about the axis? Its normals lie in planes through the axis, all but what sampling errs.
[[nodiscard]] bool is_turned(const WheelFace& face, const WheelAxis& axis, double size_mm);

/// Each face votes for the axis that its own normals have (Pottmann: the null vector of the linear complex of its normals), with
/// its area; planes and spheres, which have many, do not. None where no face is one of revolution.
[[nodiscard]] std::optional<WheelAxis> find_axis(const std::vector<WheelFace>& faces, const Box3& box);

}  // namespace flank::internal
