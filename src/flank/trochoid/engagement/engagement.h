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

#include "flank/trochoid/engagement/ridge.h"
#include "flank/trochoid/engagement/row_meter.h"
#include "flank/trochoid/engagement/row_rings.h"
#include "flank/trochoid/stock/near_poses.h"

namespace flank::internal {

struct EngagementPeak {
  double angle_rad = 0.0;
  double t = 0.0, s = 0.0;  ///< where
};

/// What a motion takes from a stock.
struct Engagement {
  EngagementPeak peak;  ///< over the rows
  double volume_mm3 = 0.0;
  std::vector<EngagementRow> rows;
};

/// Measures against one stock, rows in parallel; the same bits for any number of threads. Not for several threads at once: it
/// keeps scratch memory, so that measuring allocates little once it has grown. The stock must outlive it.
class EngagementMeter {
 public:
  explicit EngagementMeter(const SweptStock& stock) : stock_(stock), near_(stock) {}
  EngagementMeter(const EngagementMeter&) = delete;  // its rows refer to its poses
  EngagementMeter& operator=(const EngagementMeter&) = delete;

  /// When a motion over [0, 1] is measured in a row: at equal steps, of which the first is just after 0, and once more shortly
  /// before 1.
  [[nodiscard]] static double time_of(std::size_t row, int rows);
  /// The motion at these times of `rows` (>= 3), on these rings. Earlier poses of the motion itself count as swept.
  [[nodiscard]] Engagement measure(const RuledMotion& motion, std::span<const ToolRing> rings, int rows);
  [[nodiscard]] Engagement measure(const RuledMotion& motion, const RowRings& rings, int rows);
  /// The peak and the volume alone, the peak if it is more than `least_rad`: what cannot be the peak is not looked at closely. `guess`:
  /// about when it is; that row comes first.
  [[nodiscard]] Engagement measure_peak(const RuledMotion& motion, const RowRings& rings, int rows, double guess,
                                        double least_rad);
  /// Of every ring at each of `rows` (>= 3) times, row by row, into `angles`: rows x rings, radians.
  void measure_rings(const RuledMotion& motion, std::span<const ToolRing> rings, int rows, std::span<double> angles);
  /// Larger or equal: the largest engagement near the largest rows, along the ridges that cross them.
  [[nodiscard]] EngagementPeak refine(const RuledMotion& motion, const Engagement& measured, int flank_rings);
  /// Larger or equal: what a few rings at a few times around the two largest rows promise of their ridges.
  [[nodiscard]] EngagementPeak look_between(const RuledMotion& motion, const Engagement& measured);
  /// Of one ring at one time.
  [[nodiscard]] double angle(const RuledMotion& motion, double t, const ToolRing& ring);

 private:
  /// Calls use(index, row, its arcs) for each of `rows` (>= 3) times of the motion, in parallel, on the rings_of(index).
  template <class RingsOf, class Use>
  void for_each_row(const RuledMotion& motion, const RingsOf& rings_of, int rows, const Use& use);
  template <class RingsOf>
  [[nodiscard]] Engagement measured(const RuledMotion& motion, const RingsOf& rings_of, int rows);
  /// Of its rows.
  static void sum(Engagement& measured);
  /// At least so many meters of rows are there.
  void reserve(std::size_t count);
  /// What rings at equal steps of a window engage at equal steps of its time: their ridge. Larger engagement than `best` is kept there. The
  /// meter has begun.
  [[nodiscard]] Ridge ridge_in(const RuledMotion& motion, const RidgeWindow& window, int rings, RowMeter& meter,
                               EngagementPeak& best) const;
  /// The largest engagement of a ridge near one of its crests, by ever smaller windows.
  [[nodiscard]] EngagementPeak climb(const RuledMotion& motion, RidgeWindow window, RowMeter& meter) const;

  const SweptStock& stock_;
  NearPoses near_;
  std::vector<RowMeter> meters_;  ///< scratch memory, one for each task
};

/// A pass of the tool that several motions make, one after the other, like a finishing sweep with its run-outs.
struct PassMeasure {
  double largest_rad = 0.0;  ///< engagement, refined
  double volume_mm3 = 0.0;
};

/// Measures a pass, whose motions are then in the stock. `sweep_intervals`: of each (Sweep::of).
[[nodiscard]] PassMeasure measure_pass(const std::vector<RuledMotion>& motions, int sweep_intervals, SweptStock& stock);

/// Largest engagement of poses that are joined straight, radians; what the way itself takes is not counted as taken, and the stock
/// stays as it is.
[[nodiscard]] double largest_engagement(const std::vector<Pose>& way, const SweptStock& stock);

}  // namespace flank::internal
