/// Speeds along a path within the speeds and accelerations of the joints: time-optimal for the given caps, by reachability
/// analysis over the path and its squared speed (Pham and Pham 2018, in our own words in docs/algorithms/machine.md).
#pragma once

#include <span>

#include "flank/machine/feeds/feed_motion.h"

namespace flank::internal {

/// From rest to rest over the nodes (at least two). At each node the joints turn on a parabola that leaves the corner by no
/// more than `rounding` (mm, > 0; of rotary joints at a lever of kFeedLeverMm), as controls blend their blocks: nodes of a smooth motion
/// are smooth again, sharp corners are almost stops. No joint is faster than it may be, nor accelerated more, at any
/// millisecond: check_feed of the result is at most 1. Where a joint has a limit of jerk, no joint's jerk is larger (jerk.h).
[[nodiscard]] FeedPlan plan_feed(const Machine& machine, std::span<const FeedNode> nodes, double rounding);
inline constexpr double kFeedLeverMm = 100.0;

/// The fastest constant speed along the whole path (ends apart) that keeps the limits, for comparison: the smallest of what
/// each node allows. mm/s.
[[nodiscard]] double constant_speed(const Machine& machine, std::span<const FeedNode> nodes, double rounding);

}  // namespace flank::internal
