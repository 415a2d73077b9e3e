/// Poses that keep clear of the other faces of the part, by sliding along the axis where that helps.
#pragma once

#include "flank/clearance/pose_clearance.h"

namespace flank {

/// Other faces of the part, asked pose by pose. Without a checker every pose is clear.
struct LineGuard {
  const PoseChecker* checker = nullptr;
  double floor_mm = 0.0;  ///< least clearance; negative: depth that the tolerance allows
  [[nodiscard]] bool clear(const Pose& pose) const { return !checker || checker->is_free(pose, floor_mm); }
};

/// The pose slid along its own axis, by at most `reach_mm`, until it is clear; the best found if it never is.
[[nodiscard]] Pose slid_clear(const LineGuard& guard, const Pose& pose, double reach_mm);

}  // namespace flank
