/// A contact circle of a tool that moves, and the half of it that goes forward.
#pragma once

#include <cmath>

#include "flank/path/pose_velocity.h"
#include "flank/radial_function.h"
#include "flank/vec.h"

namespace flank::internal::verify {

struct FrontCircle {
  Vec3 centre = Vec3::Zero(), forward = Vec3::Zero(), side = Vec3::Zero();
  Vec3 axis = Vec3::Zero();
  double radius = 0.0;
  double sine = 0.0, cosine = 1.0;  ///< of the flank's slope: how far its normal leans to the axis
  double half = 0.0;                ///< the front is |theta| <= half, radians; 0: nothing goes forward

  [[nodiscard]] Vec3 outwards(double theta) const { return std::cos(theta) * forward + std::sin(theta) * side; }
  /// The place of the flank, and its outward normal.
  [[nodiscard]] Vec3 point(double theta) const { return centre + radius * outwards(theta); }
  [[nodiscard]] Vec3 normal(double theta) const { return cosine * outwards(theta) + sine * axis; }
};

/// Of height s on the axis.
[[nodiscard]] FrontCircle front_circle(const RadialFunction& radial, const Pose& pose, const PoseVelocity& velocity,
                                       double s);

}  // namespace flank::internal::verify
