/// The directions of a tool that a machine holds while the wheel stands upright on its table.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flank/vec.h"

namespace flank::internal {

/// A cone about `up`, wider than a half space as a rule: directions between two of it need not be in it.
struct TiltCone {
  Vec3 up = Vec3::UnitZ();                ///< unit vector of the part
  double most_rad = std::numbers::pi;     ///< between `up` and the axis, at most; pi: any direction
  static constexpr double kSame = 1e-12;  ///< of a cosine

  [[nodiscard]] bool holds(const Vec3& axis) const { return axis.dot(up) >= std::cos(most_rad) - kSame; }
  /// The direction of the cone nearest to a unit vector.
  [[nodiscard]] Vec3 nearest(const Vec3& axis) const {
    if (holds(axis)) return axis;
    const Vec3 out = axis - axis.dot(up) * up;
    const Vec3 side = out.norm() > kSame ? Vec3(out.normalized()) : Vec3(up.unitOrthogonal());
    return std::cos(most_rad) * up + std::sin(most_rad) * side;
  }
};

}  // namespace flank::internal
