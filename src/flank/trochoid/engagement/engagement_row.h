/// What a row of rings engages, summed up.
#pragma once

#include <span>

#include "flank/ruled_motion.h"
#include "flank/trochoid/engagement/ring_group.h"

namespace flank::internal {

/// What one row of rings has: a time of the motion.
struct EngagementRow {
  double t = 0.0;
  double angle_rad = 0.0, s = 0.0;  ///< the largest of the flank's rings, and where
  double mean_rad = 0.0;            ///< of the flank's rings
  double rate_mm3 = 0.0;            ///< volume removed per unit of t
};

/// Of the arcs that are in the material, in the order of the rings.
[[nodiscard]] EngagementRow sum_of(const AxisJet& axis, double t, std::span<const ToolRing> rings,
                                   std::span<const RingArc> arcs);

}  // namespace flank::internal
