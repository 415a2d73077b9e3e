/// Whether a ball of the tool touches a target, and whether it can.
#pragma once

#include <span>

#include "flank/target.h"

namespace flank::internal {

/// Is a ball of this centre and radius within reach_mm, all in mm, of the interior of one of the targets? A footpoint on a
/// border does not count: there the ball runs past the target. Of either side, so that it does not matter which one is
/// machined.
[[nodiscard]] bool ball_touches(std::span<const Target* const> targets, const Vec3& centre, double radius_mm,
                                double reach_mm);

/// Can a ball touch the target at the sample, on the machining side, and enter it nowhere deeper than depth_mm? Not in a
/// corner of the target that is narrower than the ball. Both as they are given (Target::as_given): that is what a judge looks at.
[[nodiscard]] bool ball_fits(const Target& target, const SurfaceSample& sample, double radius_mm, double depth_mm);

}  // namespace flank::internal
