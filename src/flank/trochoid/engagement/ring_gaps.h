/// What is left open of a ring of the tool while the poses of earlier sweeps are taken off it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "flank/trochoid/engagement/ring_group.h"
#include "flank/trochoid/stock/pose_filter.h"

namespace flank::internal {

/// What ends a gap: one of the candidates, or else the blank or the front's own end.
struct GapBound {
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  std::size_t candidate = kNone;
  double shift = 0.0;  ///< of intervals, from its pose
  [[nodiscard]] bool is_pose() const { return candidate != kNone; }
};

/// A stretch of a ring's front that no pose seen so far covers. It goes a little beyond where the front or the blank ends: what a
/// sweep covers between two poses may begin there.
struct RingGap {
  double low, high;  ///< radians from the direction of motion
  GapBound at_low, at_high;
  Vec2 from, to;    ///< unit vectors of low and high
  Arc limits = {};  ///< of the front in the blank
  [[nodiscard]] Arc within() const { return {std::max(low, limits.low), std::min(high, limits.high)}; }
  [[nodiscard]] bool is_some() const { return within().high > within().low; }
};

/// The gaps of one ring, apart and in their order. They keep their memory.
class RingGaps {
 public:
  using Place = std::vector<RingGap>::const_iterator;
  void clear() { gaps_.clear(); }
  void assign(Place first, Place last) { gaps_.assign(first, last); }
  /// All of a front, which goes from -half to half; (x, y): the unit vector of half.
  void open(double half, double x, double y);
  [[nodiscard]] bool empty() const { return gaps_.empty(); }
  [[nodiscard]] Place begin() const { return gaps_.begin(); }
  [[nodiscard]] Place end() const { return gaps_.end(); }
  /// Whether anything was left of [low, high], less or more any whole turn, which is taken.
  bool cut(double low, double high, const GapBound& bound);
  /// What is open now is what lies in the blank; it goes on a little beyond, where sweeps may end.
  void go_beyond();
  /// Whether an interval that a disc about `middle` takes of the ring of that radius may reach into a gap. It then holds one of its
  /// ends, or lies within.
  [[nodiscard]] bool reached_by(double ring, const Vec2& middle, double disc2) const;
  /// On the ring of that radius, turned by the unit vector `motion`.
  void arcs(double ring, const Vec2& motion, std::vector<OpenArc>& out) const;

 private:
  std::vector<RingGap> gaps_, cut_;
};

}  // namespace flank::internal
