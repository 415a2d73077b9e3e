/// The minimum of F(tau, s) over a piece of a segment (see segment.h).
#pragma once

#include "flank/verify/swept/segment.h"
#include "flank/verify/swept/tool_distance.h"

namespace flank::internal::verify {

struct SegmentMinimum {
  double f = 1e300;  ///< mm
  double tau = 0.0;  ///< on the segment, in [low, high]
  double s = 0.0;    ///< on the axis, mm, in [0, L]
};

/// Newton's method with bounds tau in [low, high], s in [0, L] from `start`, never uphill. Returns false (and the best
/// it saw) where it did not settle: F is not convex there or the point lies near the axis.
[[nodiscard]] bool descend(const Segment& segment, const RadialTable& radial, const Vec3& x, double low, double high,
                           SegmentMinimum& start);

/// The minimum over tau in [low, high] and all s without assumptions on convexity: samples tau, brackets every minimum
/// of the inner global minimum over s, and narrows each. Slow; for the cases where `descend` is not to be trusted.
[[nodiscard]] SegmentMinimum bracketed_minimum(const Segment& segment, const ToolDistance& tool, const Vec3& x,
                                               double low, double high);

}  // namespace flank::internal::verify
