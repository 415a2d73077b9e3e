/// What a motion has of plunging: an envelope is there only where |c| < 1 (MATH section 3).
#pragma once

#include "flank/vec.h"

namespace flank::internal {

/// By how much a point of the axis plunges, and that by its velocity.
struct Plunge {
  double excess = 0.0;           ///< in the unit of the velocity; 0 if |c| is below kMostPlunge
  Vec3 gradient = Vec3::Zero();  ///< of the excess by the velocity
};

/// |c| that is left alone: below 1, because a soft term gives a little and is seen at samples only.
inline constexpr double kMostPlunge = 0.8;

/// With |c| = |r'| |v_u| / (sqrt(1 - r'^2) |v_across|), v_u along the axis and v_across across it: the excess is
/// |r'| |v_u| / sqrt(1 - r'^2) - kMostPlunge |v_across|, where that is positive. `axis` has unit length, |slope| is below 1.
[[nodiscard]] Plunge plunge(const Vec3& velocity, const Vec3& axis, double slope);

}  // namespace flank::internal
