/// Seeds: first lines of strips, before refinement.
#pragma once

#include <vector>

#include "flank/surface/target.h"
#include "flank/tool/radial_function.h"

namespace flank {

/// A line that touches the target at one footpoint, by the sphere of s, in one direction of the tangent plane.
struct LineSeed {
  Vec3 point = Vec3::Zero(), normal = Vec3::UnitZ();  ///< of the target, towards the machining side
  Vec3 direction = Vec3::UnitX();                     ///< unit, across the normal: where the holder end lies
  double s = 0.0;
};

/// The axis of a seed (MATH section 5): its sphere of s touches at the footpoint, <n, u> = r'(s).
[[nodiscard]] Pose seed_pose(const LineSeed& seed, const RadialFunction& radial);

/// A simple grid: about `places` footpoints spread evenly over the target times `directions` directions over half a
/// turn, or over the whole turn where the tool's ends differ; s is the middle of the axis.
[[nodiscard]] std::vector<LineSeed> grid_seeds(const Target& target, const RadialFunction& radial, int places,
                                               int directions);

/// The directions of a grid at a point: `directions` over half a turn, twice as many over the whole.
[[nodiscard]] std::vector<Vec3> seed_directions(const Vec3& normal, const RadialFunction& radial, int directions);

/// Are both ends of the tool alike, r(s) = r(L - s)? Then a line turned round is the same line.
[[nodiscard]] bool is_symmetric(const RadialFunction& radial);

}  // namespace flank
