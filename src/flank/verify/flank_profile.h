/// The outline of the cutting flank as a polyline.
#pragma once

#include <vector>

#include "flank/tool/radial_function.h"

namespace flank::verify {

/// Largest distance between the polyline and the flank, mm.
inline constexpr double kFlankProfileErrorMm = 5e-4;

/// Profile (z, radius) of the union of the spheres of `radial`, its round ends included; z does not fall. Its points lie on the
/// outline, and no point of the outline is farther than kFlankProfileErrorMm from it.
[[nodiscard]] std::vector<Vec2> flank_profile(const RadialFunction& radial);

}  // namespace flank::verify
