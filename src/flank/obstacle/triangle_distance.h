/// The least signed distance of a triangle to a posed convex body, with a proof.
#pragma once

#include <array>

#include "flank/obstacle/convex_profile.h"

namespace flank::internal {

struct TriangleDistance {
  double value = 0.0;  ///< at `point`; if the cutoff was not met, a lower bound of all values
  bool below = false;  ///< value < cutoff: the other fields hold
  Vec3 point = Vec3::Zero();
  BodyJet jet;  ///< there
};

/// Distances are exact to this, mm; depths to kDepthShareError of themselves besides (no unit).
inline constexpr double kTriangleDistanceError = 1e-8;
inline constexpr double kDepthShareError = 1e-3;

/// A signed distance that is convex lies above its tangent planes: value - min over the corners of <gradient, x -
/// corner> bounds it from below on the whole triangle. Newton's method within the triangle runs until that bound
/// closes; where the distance has kinks (inside the body) the triangle is divided instead. `any`: the first place below
/// the cutoff will do.
[[nodiscard]] TriangleDistance triangle_distance(const ConvexProfile& body, const Pose& pose,
                                                 const std::array<Vec3, 3>& corners, double cutoff, bool any = false);

}  // namespace flank::internal
