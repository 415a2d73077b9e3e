/// Speeds along a path within the speeds and accelerations of the joints: time-optimal for the given caps, by reachability
/// analysis over the path and its squared speed (Pham and Pham 2018, in our own words in docs/algorithms/machine.md).
#pragma once

#include <array>
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
  double time_s = 0.0;
};

/// What joints do, as shares of their limits, sampled every millisecond.
struct FeedCheck {
  JointValues speed{}, acceleration{};                 ///< largest, in the joints' own units
  double worst_speed = 0.0, worst_acceleration = 0.0;  ///< largest share of a limit
  std::size_t samples = 0;
};

/// From rest to rest over the nodes (at least two). At each node the joints turn on a parabola that leaves the corner by no
/// more than `rounding` (mm, > 0; of rotary joints at a lever of kFeedLeverMm), as controls blend their blocks: nodes of a smooth motion
/// are smooth again, sharp corners are almost stops. No joint is faster than it may be, nor accelerated more, at any
/// millisecond: check_feed of the result is at most 1.
[[nodiscard]] FeedPlan plan_feed(const Machine& machine, std::span<const FeedNode> nodes, double rounding);
inline constexpr double kFeedLeverMm = 100.0;

/// Samples the motion of a plan at 1 kHz: speeds by first, accelerations by second differences.
[[nodiscard]] FeedCheck check_feed(const Machine& machine, std::span<const FeedNode> nodes, const FeedPlan& plan);

/// The fastest constant speed along the whole path (ends apart) that keeps the limits, for comparison: the smallest of what
/// each node allows. mm/s.
[[nodiscard]] double constant_speed(const Machine& machine, std::span<const FeedNode> nodes, double rounding);

}  // namespace flank::internal
