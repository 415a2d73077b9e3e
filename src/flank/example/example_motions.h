/// The motions of the examples.
#pragma once

#include "flank/ruled_motion.h"

namespace flank::internal {

inline constexpr int kExampleMotions = 3;

/// Motion 1: a gentle blade-like sweep of 70 mm; 2: 80 mm with 70 degrees of twist about the travel; 3: 85 mm along a
/// curve with an inflection, the axis leaning forward and back. All travel along +x with the axis near +z, so that
/// contact side +1 looks to +y. Each rail is one cubic Bezier piece: smooth in t, and in the space of every fit,
/// whatever its knots.
[[nodiscard]] RuledMotion example_motion(int number, double axis_length);

/// A motion that faces example_motion(1) across a cavity about 15 mm plus two radii wide: along -x, contact side +1 to
/// -y.
[[nodiscard]] RuledMotion facing_motion(double axis_length);

}  // namespace flank::internal
