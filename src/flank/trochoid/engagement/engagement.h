/// How much of the tool is in the material while it moves: engagement angle and removed volume (MATH section 10).
///
/// On a ring of the tool, the front is |theta| <= theta_c from the direction of motion across the axis, with
/// cos(theta_c) = r' <u, v> / (sqrt(1 - r'^2) |v_perp|): there the surface moves outwards. The engagement is the measure of
/// the front that lies in the blank and in no earlier sweep. What an earlier pose covers of a ring is an interval in closed
/// form, but for a small tilt; the ends of the union of these intervals are then moved to where the gap to the swept volume
/// vanishes, continuously in time.
#pragma once

#include <span>
#include <vector>

#include "flank/trochoid/engagement/arc_end.h"
#include "flank/trochoid/engagement/near_poses.h"
#include "flank/trochoid/engagement/pose_filter.h"

namespace flank::internal {

/// An arc of a ring that is in the material, radians from the direction of motion, towards u x motion.
struct Arc {
  double low = 0.0, high = 0.0;
};

struct EngagementPeak {
  double angle_rad = 0.0;
  double t = 0.0, s = 0.0;  ///< where
};

/// What one row of rings has: a time of the motion.
struct EngagementRow {
  double t = 0.0;
  double angle_rad = 0.0, s = 0.0;  ///< the largest of the flank's rings, and where
  double mean_rad = 0.0;            ///< of the flank's rings
  double rate_mm3 = 0.0;            ///< volume removed per unit of t
};

/// What a motion takes from a stock.
struct Engagement {
  EngagementPeak peak;  ///< over the rows
  double volume_mm3 = 0.0;
  std::vector<EngagementRow> rows;
};

/// Measures against one stock. Not for several threads at once: it keeps scratch memory, so that measuring allocates
/// nothing once it has grown. The stock must outlive it.
class EngagementMeter {
 public:
  explicit EngagementMeter(const SweptStock& stock) : stock_(stock), near_(stock) {}

  /// The motion over [0, 1] at `rows` (odd, >= 3) times, on these rings. Earlier poses of the motion itself count as swept.
  [[nodiscard]] Engagement measure(const RuledMotion& motion, std::span<const ToolRing> rings, int rows);
  /// Larger or equal: the largest engagement near the largest rows, by golden section in t and, inside the axis, in s.
  [[nodiscard]] EngagementPeak refine(const RuledMotion& motion, const Engagement& measured, int flank_rings);
  /// Of one ring at one time.
  [[nodiscard]] double angle(const RuledMotion& motion, double t, const ToolRing& ring);

 private:
  /// Whose sweep ends a gap: a pose, or the blank (sweep = kNoSweep), or the front's own end.
  struct Bound {
    int sweep = kNoSweep, pose = 0;
  };
  /// A stretch of a ring's front that no pose seen so far covers.
  struct Gap {
    double low, high;  ///< radians from the direction of motion
    Bound at_low, at_high;
    Vec2 from, to;  ///< unit vectors of low and high
  };
  /// An arc and the ring that it is on.
  struct RingArc {
    std::size_t ring;
    double motion_angle;
    Arc arc;
  };
  [[nodiscard]] static RowFrame frame_of(const RuledMotion& motion, double t);
  /// The arcs of all rings at a time, into found_.
  void find_arcs(const RowFrame& frame, double t, std::span<const ToolRing> rings);
  void engage_all(const RowFrame& frame, std::span<const ToolRing> rings, bool rough);
  /// What the first look left open: a disc that holds it, and small ones, into parts_, that hold it together.
  [[nodiscard]] RowDisc discs_of_found(std::span<const ToolRing> rings);
  [[nodiscard]] EngagementRow sum_row(const RowFrame& frame, double t, std::span<const ToolRing> rings) const;
  /// Adds the arcs of a ring to found_.
  void engage(const RowFrame& frame, const ToolRing& ring, std::size_t index, bool rough);
  void cut_by_blank(const RowFrame& frame, const ToolRing& ring, double motion_angle);
  void cut_by_poses(const ToolRing& ring, double motion_angle);
  /// Around the gaps: the tool of a pose whose axis is beyond all of them reaches into none. `motion`: the direction of
  /// motion, which the gaps are measured from.
  [[nodiscard]] const std::vector<ReachDisc>& discs_of_gaps(const ToolRing& ring, const Vec2& motion);
  /// False if the candidate covers the whole ring.
  [[nodiscard]] bool cut_by(const NearPose& candidate, const ToolRing& ring, const Vec2& motion);
  void cut(double low, double high, const Bound& bound);
  void settle(const RowFrame& frame, const ToolRing& ring, std::size_t index, double motion_angle, double half,
              bool rough);
  [[nodiscard]] SweepPlace place_of(const Bound& bound) const;
  [[nodiscard]] bool is_sliver(const RingCircle& circle, const Gap& gap) const;
  /// Engagement of the ring of s at a time; kept in `best` if it is larger.
  double value(const RuledMotion& motion, double t, double s, EngagementPeak& best);
  [[nodiscard]] const Sweep& sweep_of(int index) const {
    return index == kOwnSweep ? near_.own() : stock_.sweeps()[static_cast<std::size_t>(index)];
  }

  static constexpr int kNoSweep = -1;
  /// A first look, at every kStride-th pose of the last sweeps, says where material may be; only there all poses count.
  static constexpr std::size_t kRecent = 3;
  static constexpr int kStride = 4;
  const SweptStock& stock_;
  NearPoses near_;
  PoseFilter filter_;
  double own_last_ = 0.0;  ///< earlier poses of the motion count up to this place
  std::vector<NearPose> candidates_;
  std::vector<RowDisc> parts_;
  std::vector<ReachDisc> reaches_;
  std::vector<Gap> gaps_, cut_;
  std::vector<std::size_t> hints_;  ///< candidates that ended the gaps of the ring before
  std::vector<RingArc> found_;
};

}  // namespace flank::internal
