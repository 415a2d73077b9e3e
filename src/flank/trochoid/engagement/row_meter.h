/// One time of a motion against the stock: which arcs of the tool's rings are in the material (engagement.h).
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "flank/trochoid/engagement/arc_end.h"
#include "flank/trochoid/engagement/engagement_row.h"
#include "flank/trochoid/engagement/leaning_tool.h"
#include "flank/trochoid/engagement/ring_gaps.h"
#include "flank/trochoid/engagement/ring_group.h"
#include "flank/trochoid/stock/near_poses.h"
#include "flank/trochoid/stock/pose_filter.h"

namespace flank::internal {

/// Not for several threads at once: it keeps scratch memory, so that measuring allocates nothing once it has grown. The
/// stock and the poses near the motion must outlive it.
class RowMeter {
 public:
  RowMeter(const SweptStock& stock, const NearPoses& near)
      : stock_(stock), near_(near), filter_(stock.profile()), seen_filter_(stock.profile()) {}

  /// Before the first of some rows of one motion, which follow one another: what settles one of them is asked first at the next.
  void begin() { settlers_.clear(); }
  /// The same, before rows that are like the last one of another meter.
  void begin_after(const RowMeter& other) { settlers_ = other.settlers_; }
  /// The time t in [0, 1] of the motion that `near` has begun. Of rings without an area what engages no more than `least_rad` may be
  /// left out.
  [[nodiscard]] EngagementRow row(const RuledMotion& motion, double t, std::span<const ToolRing> rings,
                                  double least_rad = 0.0);
  /// The arcs of the last row, in the order of its rings.
  [[nodiscard]] const std::vector<RingArc>& found() const { return found_; }

 private:
  /// The part of a ring whose surface moves outwards.
  struct Front {
    double half = 0.0, angle = 0.0;  ///< half of it; the direction of motion in the frame of the row: radians
    Vec2 motion = Vec2::UnitX();     ///< that direction
    std::size_t end = 0;             ///< of its gaps in open_gaps_
  };
  /// A pose by its place in the stock.
  struct Settler {
    int sweep, pose;
    bool operator==(const Settler&) const = default;
  };
  /// A plane of the blank in the frame of the row: length and direction of its normal across the axis.
  struct Plane {
    double across, angle;
  };
  [[nodiscard]] static RowFrame frame_of(const RuledMotion& motion, double t);
  /// The arcs of all rings at a time, into found_.
  void find_arcs(const RowFrame& frame, double t, std::span<const ToolRing> rings, double least_rad);
  /// Which arcs the last sweeps leave open, into found_ and open_gaps_.
  void look_roughly(const RowFrame& frame, std::span<const ToolRing> rings);
  /// Nothing is left open of rings without an area that engage no more than this, as far as the rough look tells.
  void leave_out(std::span<const ToolRing> rings, double least_rad);
  /// What all sweeps leave of these, into found_.
  void look_closely(const RowFrame& frame, std::span<const ToolRing> rings);
  /// The same of the rings that are in wanted_, by the poses in seen_.
  void look_at_groups(const RowFrame& frame, std::span<const ToolRing> rings);
  /// What all candidates leave of a ring, into found_.
  void settle_ring(const RowFrame& frame, std::span<const ToolRing> rings, std::size_t k);
  /// Into group_: those of the poses that were seen that may cover something of what is open of the wanted ones of rings `first` to `end`.
  void find_group(std::span<const ToolRing> rings, std::size_t first, std::size_t end);
  /// Where a ring's gaps begin in open_gaps_.
  [[nodiscard]] std::size_t first_gap(std::size_t ring) const { return ring == 0 ? 0 : fronts_[ring - 1].end; }
  /// What of it is in the blank, and a little beyond, into gaps_.
  [[nodiscard]] Front front_of(const RowFrame& frame, const ToolRing& ring);
  void look_at_blank(const RowFrame& frame);
  void cut_by_blank(const RowFrame& frame, const ToolRing& ring, double motion_angle);
  void cut_by_poses(const ToolRing& ring, const Front& front);
  /// False if the candidate covers the whole ring.
  [[nodiscard]] bool cut_by(std::size_t candidate, const ToolRing& ring, const Vec2& motion);
  /// False if the disc covers the whole ring. `matters(centre, squared radius)`: whether it may reach into a gap.
  template <class Matters>
  [[nodiscard]] bool cut_by_disc(const GapBound& bound, const ToolRing& ring, const RingDisc& disc,
                                 const Matters& matters);
  /// The same of the sphere of the candidate's round end that is nearer.
  template <class Matters>
  [[nodiscard]] bool cut_by_round_end(std::size_t candidate, const ToolRing& ring, const Vec2& motion,
                                      const Matters& matters);
  /// Where the middle of a round end of its sweep is, an interval or less from a candidate, in the frame of the row.
  [[nodiscard]] Vec3 round_end_at(const NearPose& candidate, double shift, double centre) const;
  /// Whether the candidate leans so far that it does not cover the ring as a circle in its plane would.
  [[nodiscard]] bool is_leaning(const NearPose& candidate, const ToolRing& ring) const;
  /// How far a leaning tool reaches from its axis in the plane of a ring, at most, mm.
  [[nodiscard]] double reach_of_leaning(const NearPose& candidate) const;
  /// `foot`, `lean`: where the candidate's axis meets the ring's plane, and the part of its direction in it, from the direction
  /// of motion.
  void cut_by_leaning(std::size_t candidate, const ToolRing& ring, const Vec2& foot, const Vec2& lean);
  void cut(double low, double high, const GapBound& bound);
  /// Keeps for the next row the poses that end what is left of a ring, or that leave nothing.
  void keep_settlers();
  void keep_bounds_of(const RingGap& gap);
  void keep_settler(std::size_t candidate);
  /// Adds the arcs of the ring whose gaps are left to found_; those that meet are one.
  void settle(const RowFrame& frame, const ToolRing& ring, std::size_t index, const Front& front);
  [[nodiscard]] SweepPlace place_of(const GapBound& bound) const;
  [[nodiscard]] bool is_sliver(const RingCircle& circle, const RingGap& gap) const;
  [[nodiscard]] const Sweep& sweep_of(int index) const {
    return index == kOwnSweep ? near_.own() : stock_.sweeps()[static_cast<std::size_t>(index)];
  }

  /// A first look, at some poses of the last sweeps, says where material may be; only there all poses count.
  static constexpr std::size_t kRecent = 3;
  /// Of the poses that settled the row before so many are part of the first look.
  static constexpr std::size_t kMostSettlers = 48;
  /// So many rings are worth the look at groups of them; so few poses are asked without another look at each ring.
  static constexpr std::size_t kManyRings = 24, kFewPoses = 12;
  const SweptStock& stock_;
  const NearPoses& near_;
  PoseFilter filter_, seen_filter_;  ///< of candidates or of a group of rings, and of all that was seen
  SeenPoses seen_;
  RowFrame frame_;
  double own_last_ = 0.0;  ///< earlier poses of the motion count up to this place
  std::vector<NearPose> candidates_;
  std::size_t first_asked_ = 0;     ///< of the candidates, of those that filter_ has
  std::vector<std::size_t> group_;  ///< what filter_ has, as indices of seen_; none: all candidates
  std::vector<RowDisc> parts_;
  WantedRings wanted_;
  NearScratch scratch_;
  std::vector<OpenArc> open_;
  RingGaps gaps_;  ///< of the ring that is looked at
  std::vector<Plane> planes_;
  std::vector<Front> fronts_;       ///< of the rings of the row
  std::vector<RingGap> open_gaps_;  ///< and what the first look left open of them, ring by ring
  std::vector<Arc> covered_;
  OpenSectors sectors_;
  std::vector<std::size_t> cutters_;               ///< candidates that cut the gaps of this ring
  std::vector<std::size_t> hints_;                 ///< those of the ring before, the last ones first
  std::vector<Settler> settlers_, next_settlers_;  ///< of the row before, of this one
  std::vector<RingArc> found_;
};

}  // namespace flank::internal
