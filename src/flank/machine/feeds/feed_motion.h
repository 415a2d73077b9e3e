/// A path with the times at which a machine passes it, and what its joints do there, millisecond by millisecond.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "flank/machine/model/machine.h"

namespace flank::internal {

/// A place of the path: joints run straight from one to the next.
struct FeedNode {
  JointValues joints{};
  double length = 0.0;     ///< of the contact's way from the node before, mm, >= 0
  double cap = 0.0;        ///< fastest along that way, mm/s, > 0
  std::int32_t block = 0;  ///< what the way belongs to
};

struct FeedPlan {
  std::vector<double> seconds;  ///< of the way to each node; 0 of the first
  std::vector<double> speed;    ///< along the path at each node, mm/s; 0 at both ends
  std::vector<double> step;     ///< length of the way to each node, mm
  std::vector<double> bend;     ///< length of the parabola at each node, mm
  /// With limits of jerk: the place along the path every millisecond, mm, the mean of `average` places of a plan without them. Else the speed
  /// runs linearly over each way.
  std::vector<double> way;
  std::size_t average = 1;
  double time_s = 0.0;
};

/// What joints do, as shares of their limits, sampled every millisecond.
struct FeedCheck {
  JointValues speed{}, acceleration{};                 ///< largest, in the joints' own units
  double worst_speed = 0.0, worst_acceleration = 0.0;  ///< largest share of a limit
  std::size_t samples = 0;
};

/// Samples the motion of a plan at 1 kHz: speeds by first, accelerations by second differences.
[[nodiscard]] FeedCheck check_feed(const Machine& machine, std::span<const FeedNode> nodes, const FeedPlan& plan);

/// s: what a servo sees.
inline constexpr double kFeedTick = 1e-3;

/// The joints at a share of the way to node i, on the parabolas at its ends.
[[nodiscard]] JointValues joints_at(std::span<const FeedNode> nodes, const FeedPlan& plan, std::size_t i, double share);

/// A place of a plan: a share of the way to a node. The node after the last one: the end is passed.
struct FeedPlace {
  std::size_t node = 1;
  double share = 0.0;
};

/// Where a plan is at ever later milliseconds.
class FeedClock {
 public:
  explicit FeedClock(const FeedPlan& plan) : plan_(plan) {}
  [[nodiscard]] FeedPlace at(std::size_t tick);

 private:
  const FeedPlan& plan_;
  std::size_t node_ = 1;
  double begun_ = 0.0;  ///< at the node before: the time, or the way of a plan that tells it
};

/// How many milliseconds a plan takes, and two at rest.
[[nodiscard]] inline std::size_t tick_count(const FeedPlan& plan) {
  return static_cast<std::size_t>(std::ceil(plan.time_s / kFeedTick)) + 2;
}

/// visit(first, last node around, joints at t - tick, t, t + tick).
template <class Visit>
void sample(std::span<const FeedNode> nodes, const FeedPlan& plan, const Visit& visit) {
  FeedClock clock(plan);
  JointValues before = nodes.front().joints, here = before;
  std::size_t node_before = 0, node_here = 0;
  const std::size_t ticks = tick_count(plan), end = nodes.size();
  for (std::size_t k = 1; k <= ticks; ++k) {
    const FeedPlace place = clock.at(k);
    const std::size_t i = place.node;
    const JointValues next = i < end ? joints_at(nodes, plan, i, place.share) : nodes.back().joints;
    visit(node_before, std::min(i, end - 1), before, here, next);
    before = here;
    here = next;
    node_before = node_here;
    node_here = std::min(i, end - 1) - (i < end ? 1 : 0);
  }
}

/// The largest share of a limit over the joints, at one millisecond.
struct JointShares {
  double speed = 0.0, acceleration = 0.0;
};
[[nodiscard]] JointShares joint_shares(const Machine& machine, const JointValues& before, const JointValues& here,
                                       const JointValues& next);

/// What counts as more than a limit: rounding of the differences.
inline constexpr double kFeedSlack = 1e-6;

}  // namespace flank::internal
