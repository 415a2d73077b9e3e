/// Seeds: first lines of strips, before refinement. They need not be within tolerance; REFINE (line_fit.h) decides
/// that.
#pragma once

#include <vector>

#include "flank/cover_options.h"
#include "flank/radial_function.h"
#include "flank/target.h"

namespace flank::internal {

/// The axis of a seed (MATH section 5): its sphere of s touches at the footpoint, <n, u> = r'(s). Needs |r'(s)| < 1.
/// Contact of first order: whether the target's curvature suits the tool there is not checked.
[[nodiscard]] Pose seed_pose(const LineSeed& seed, const RadialFunction& radial);

/// At each place the directions of seed_directions(.., directions), touching with the middle of the axis.
[[nodiscard]] std::vector<LineSeed> even_seeds(const std::vector<SurfaceSample>& places, const RadialFunction& radial,
                                               int directions);

/// At each place, for each of `spheres` values of s (the middles of equal pieces of the axis: over s, not over r, which
/// may have a value at several s), the directions that the tolerance-aware filter leaves (direction_filter.h).
[[nodiscard]] std::vector<LineSeed> admissible_seeds(const Target& target, const std::vector<SurfaceSample>& places,
                                                     const RadialFunction& radial, int spheres, double tolerance_mm);

/// About `count` > 0 places, spread evenly over the target, in a fixed order.
[[nodiscard]] std::vector<SurfaceSample> grid_places(const Target& target, int count);

/// Unit directions across `normal`, at equal angles: `directions` over half a turn if both ends of the tool are alike,
/// else twice as many over the whole turn.
[[nodiscard]] std::vector<Vec3> seed_directions(const Vec3& normal, const RadialFunction& radial, int directions);

/// Whether both ends of the tool are alike, r(s) = r(L - s) to 1e-9 of L at 17 places. Then a line turned round is the
/// same line, and half of all directions are enough.
[[nodiscard]] bool is_symmetric(const RadialFunction& radial);

}  // namespace flank::internal
