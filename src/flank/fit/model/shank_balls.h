/// The shank above a flank as balls along the tool's axis, as the flank is (MATH section 7).
#pragma once

#include <vector>

#include "flank/fit.h"
#include "flank/radial_function.h"

namespace flank::internal {

/// Balls of radius R a third of R' apart meet at R', the cylinder's radius: R / R'.
inline constexpr double kShankGrown = 1.0137937550497031;

/// Radius of the balls of the shank that the bounds have, mm: of a cylinder as thick as the bounds say, or else as the flank's upper end.
/// They stand a third of that apart at most (shank_places), and are larger by kShankGrown, so that they hold the cylinder.
[[nodiscard]] double shank_ball(const RadialFunction& tool, const RadiusBounds& bounds);

/// Places of these balls along the axis, mm from s = 0, all above the flank; none without a shank in the way.
[[nodiscard]] std::vector<double> shank_places(const RadialFunction& tool, const RadiusBounds& bounds);

}  // namespace flank::internal
