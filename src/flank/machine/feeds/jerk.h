/// Limits of the joints' jerk: a plan's place over time is smoothed, and the path itself stays as it is (docs/algorithms/machine.md).
#pragma once

#include <span>
#include <vector>

#include "flank/machine/feeds/feed_motion.h"

namespace flank::internal {

[[nodiscard]] bool has_jerk_limits(const Machine& machine);

/// The plan with its place along the path averaged over a time in which each joint may change its acceleration by the largest it has. On one
/// straight way this is the fastest motion with these limits wherever the plan reaches its largest speed.
[[nodiscard]] FeedPlan smoothed(const Machine& machine, std::span<const FeedNode> nodes, FeedPlan plan);

/// Where a smoothed plan exceeds a limit: the nodes that its average is made of, and by what factor their squared speed is too large.
struct TooFast {
  std::size_t first = 0, last = 0;
  double over = 1.0;
};
[[nodiscard]] std::vector<TooFast> too_fast(const Machine& machine, std::span<const FeedNode> nodes,
                                            const FeedPlan& smoothed);

/// The same, slowed down as a whole until no limit is exceeded.
[[nodiscard]] FeedPlan stretched(const Machine& machine, std::span<const FeedNode> nodes, FeedPlan smoothed);

}  // namespace flank::internal
