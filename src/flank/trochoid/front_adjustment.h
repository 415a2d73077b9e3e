/// The adjustment stage of the published method (paper C, section 3.3.3), to compare with: a front that goes too far is
/// moved back only where the engagement is above the limit.
#pragma once

#include <optional>

#include "flank/trochoid/engagement/engagement.h"

namespace flank::internal {

/// The front with other inner control points, so that its engagement with the meter's stock is at most `largest_rad` at
/// 101 x 21 samples; none if ten rounds do not get there. Each round moves the points of the envelope whose engagement is
/// above the limit back along the envelope's normal, until the place of the ring that may just be engaged has left the
/// material (C's figure 8), and fits the inner control points of both rails to the envelope that was moved. The ends and
/// their tangents stay.
[[nodiscard]] std::optional<RuledMotion> adjusted_front(RuledMotion front, EngagementMeter& meter,
                                                        const SweptStock& stock, double largest_rad);

}  // namespace flank::internal
