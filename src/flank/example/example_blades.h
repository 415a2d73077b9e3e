/// Blade sides given by formulas. Open sheets; the machining side (S_u x S_v) is the convex one where there is one.
#pragma once

#include "flank/face.h"

namespace flank::internal {

/// Side of a ruled impeller blade: rulings of 50 mm along which the normal turns by 50 degrees (a helicoid of pitch
/// fitting to that on a bent spine), edges about 77 mm. Bicubic along the edges, linear along the rulings (v).
[[nodiscard]] Face ruled_blade();

/// Convex side of a compressor blade: chord 46 to 40 mm, height 60 mm, twist of 30 degrees from root to tip, camber
/// falling from 8 to 5 percent of the chord, leaned in a bow. Not ruled. u from trailing to leading edge, v up the
/// span.
[[nodiscard]] Face twisted_blade();

/// Twist of the twisted blade's chord from root (v = 0) to tip (v = 1).
inline constexpr double kTwistedBladeTwistRad = 30.0 * 3.14159265358979323846 / 180.0;

/// Convex side, round across (radius 45 to 49 mm, 60 degrees) and almost straight along 45 mm (radius 20 m): slightly
/// elliptic, for cones. No cone touches it exactly; the best leaves about L^2 / 16 times the gap of curvature, 6
/// micrometres.
[[nodiscard]] Face elliptic_side();

}  // namespace flank::internal
