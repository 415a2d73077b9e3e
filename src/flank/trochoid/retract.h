/// Ways of the tool out of a cavity and into it, where nothing is cut.
#pragma once

#include <vector>

#include "flank/path.h"
#include "flank/trochoid/half_guard.h"

namespace flank::internal {

/// Where a tool is clear: `top` is a unit vector out of the cavity, and at `height` along it nothing is left.
struct ClearPlane {
  Vec3 top;
  double height = 0.0;
};

/// Poses from `from` until the tip is above the plane, the axis turning nowhere: along the axis, or else another way of which
/// no more is known to enter a face (straight up; between both; `outward`, along the feed's run-out, and then up; zero: that way is closed). Where every
/// way enters one deeper than `allowed_mm`, the one that enters least.
[[nodiscard]] std::vector<Pose> retract(const Pose& from, const Vec3& outward, const ClearPlane& clear,
                                        const RadialFunction& radial, const HalfGuard& guard, double allowed_mm);

}  // namespace flank::internal
