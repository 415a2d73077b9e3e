/// From a meridian profile to the radial function whose spheres it envelopes (the inverse of meridian_point).
#pragma once

#include <optional>
#include <span>

#include "flank/radial_function.h"

namespace flank::internal {

/// Spline radial function with `coefficients` (at least 4) coefficients through a profile of points (z, rho), z along
/// the axis and rho from it, in the order from the tip to the holder; points of one smooth curve, no repeated ones, at
/// least 4. The normal of the profile at a point meets the axis at s = z + rho rho', at distance r = rho sqrt(1 +
/// rho'^2) (MATH section 1). That start is improved by least squares on the distance between points and enveloped
/// profile, which needs no derivative of the points; exact to round-off where the profile is that of such a spline.
/// With `axis_length` (mm) the profile's z is kept (s = 0 at z = 0) and its normals are to meet the axis over [0, L],
/// up to 1 percent of L; without, s = 0 is where the first point's normal meets the axis, and L ends where the last
/// one's does. Throws InputError, naming the point, if rho <= 0, if z or s do not grow along the profile (no spheres
/// can be inscribed), or if [0, L] is not covered.
[[nodiscard]] RadialFunction radial_from_meridian(std::span<const Vec2> profile, std::optional<double> axis_length,
                                                  int coefficients);

}  // namespace flank::internal
