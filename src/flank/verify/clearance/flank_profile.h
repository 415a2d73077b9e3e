/// The cutting flank as convex bodies.
#pragma once

#include <vector>

#include "flank/radial_function.h"
#include "flank/verify/clearance/revolved.h"

namespace flank::internal::verify {

/// Largest distance between the polyline and the flank, mm. It is added to the bound of every clearance of the flank,
/// so it is half of ClearanceOptions::accuracy_mm.
inline constexpr double kFlankProfileErrorMm = 5e-4;

/// Meridian (z, radius) of `radial` as a polyline whose points lie on it, z growing; no point of the meridian is
/// farther than kFlankProfileErrorMm from it.
[[nodiscard]] std::vector<Vec2> flank_profile(const RadialFunction& radial);

/// The flank, a union of spheres, as convex bodies: what turns below the meridian, and the balls that round its ends.
[[nodiscard]] std::vector<Revolved> flank_bodies(const RadialFunction& radial);

}  // namespace flank::internal::verify
