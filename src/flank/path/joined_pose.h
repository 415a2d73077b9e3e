/// What a path means between two poses.
#pragma once

#include "flank/path.h"

namespace flank::internal {

/// Straight joins of poses, as paths have them: the tip and the unnormalised axis run linearly. At t in [0, 1].
[[nodiscard]] Pose joined_pose(const Pose& from, const Pose& to, double t);
/// Bound of |d^2 u/dt^2| of such a join, radians.
[[nodiscard]] double joined_bend(const Pose& from, const Pose& to);

}  // namespace flank::internal
