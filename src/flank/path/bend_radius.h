/// How sharply the paths of tip and holder end bend.
#pragma once

#include "flank/path.h"

namespace flank::internal {

/// The least radii over all strips, each strip for itself: at a pose, the mean length of the ways to and from it over
/// 2 tan(half the turn between them), which is the radius of the circle that the poses lie on up to the second order in
/// their spacing, and 0 where the path goes back the way it came. Poses between which an end moves by less than
/// `still_mm` (> 0) count as one: what is smaller than a path is known to has no bend.
[[nodiscard]] BendRadii least_bend_radii(const Path& path, double axis_length, double still_mm);

}  // namespace flank::internal
