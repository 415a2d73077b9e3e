/// How near can a ball come to touching a face at a point, if it must not cut any face by more than it leaves there?
#pragma once

#include <vector>

#include "flank/target.h"
#include "flank/verify/clearance/winding.h"

namespace flank::internal {

/// What a ball must not cut, and where it cannot be.
struct BallScene {
  std::vector<const Target*> faces;  ///< that must not be cut, the face of the site among them
  /// Closed solids all of whose faces are among these: no tool is in one of them. Their triangles are within a tenth of the radius of the faces.
  std::vector<const verify::Winding*> solids = {};
  /// The face of the site belongs to one of these solids. Else it is machined from the side of its normal: a centre is no more than half a
  /// radius behind the plane that touches the face at the site.
  bool of_solid = false;
};

struct BallSearch {
  double gap = 0.05;       ///< ends when the bound is at most this share below what a ball reaches
  double enough_mm = 0.0;  ///< or when a ball reaches this: then the bound says nothing
  int cubes = 20000;       ///< or after so many cubes of centres
};

struct LeastError {
  double bound_mm = 0.0;  ///< every ball of the radius leaves or cuts at least this much
  double found_mm = 0.0;  ///< the ball about `centre` leaves and cuts no more than this
  Vec3 centre = Vec3::Zero();
  int cubes = 0;  ///< of centres that were looked at, the first ball among them
};

/// Of all balls of this radius with their centres outside of the solids: the least of what a ball leaves at `point` and cuts from any of the
/// faces, whichever is more. Proved, up to footpoints and rounding, for every tool of which no radius is smaller: it holds such a ball, or the
/// middle of its axis is in a solid.
[[nodiscard]] LeastError least_error(const Vec3& point, const Vec3& normal, const BallScene& scene, double radius_mm,
                                     const BallSearch& search);

}  // namespace flank::internal
