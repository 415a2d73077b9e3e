#include "flank/trochoid/engagement/engagement_row.h"

#include <algorithm>
#include <cmath>

namespace flank::internal {

EngagementRow sum_of(const AxisJet& axis, double t, std::span<const ToolRing> rings, std::span<const RingArc> arcs) {
  EngagementRow row;
  row.t = t;
  int flank = 0;
  auto found = arcs.begin();
  for (std::size_t k = 0; k < rings.size(); ++k) {
    const ToolRing& ring = rings[k];
    const Vec3 v = axis.velocity(ring.s);
    const double along = v.dot(axis.u), across = std::sqrt(std::max(0.0, v.squaredNorm() - along * along));
    double angle = 0.0;
    for (; found != arcs.end() && found->ring == k; ++found) {
      const Arc& arc = found->arc;
      angle += arc.high - arc.low;
      if (ring.area != 0.0)
        row.rate_mm3 += ring.area * (ring.sine * along * (arc.high - arc.low) +
                                     ring.cosine * across * (std::sin(arc.high) - std::sin(arc.low)));
    }
    if (!ring.flank || !ring.asked) continue;
    if (!ring.between) ++flank, row.mean_rad += angle;
    if (angle <= row.angle_rad) continue;
    row.angle_rad = angle;
    row.s = ring.s;
  }
  if (flank > 0) row.mean_rad /= flank;
  return row;
}

}  // namespace flank::internal
