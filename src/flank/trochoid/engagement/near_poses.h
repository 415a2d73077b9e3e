/// Which earlier poses may cover something of a row of rings: most of the time of a measure goes by asking those that do
/// not, so they are left out early, bundle by bundle.
#pragma once

#include <span>
#include <vector>

#include "flank/ruled_motion.h"
#include "flank/trochoid/engagement/swept_stock.h"

namespace flank::internal {

/// The row's pose and a frame across it.
struct RowFrame {
  AxisJet axis;
  Vec3 x, y;
};

/// In that frame, seen along the axis: where earlier poses matter.
struct RowDisc {
  double x = 0.0, y = 0.0, radius = 0.0;
  double low = 0.0, high = 0.0;  ///< heights of its rings over the tip, mm
};

/// A pose that may cover something of a row: its axis in the frame of the row, linear in the height z.
struct NearPose {
  double x0 = 0.0, y0 = 0.0, dx = 0.0, dy = 0.0;  ///< where it meets the ring's plane
  double h0 = 0.0, dh = 0.0;                      ///< at which of its own heights
  int sweep = 0, pose = 0;
  [[nodiscard]] double slope2() const { return dx * dx + dy * dy; }
};

/// Slope of an axis against that of the rings from which on its tool is taken as leaning: 3 degrees.
inline constexpr double kLeaning = 0.05;

/// In place of the index of a sweep: the motion that is measured.
inline constexpr int kOwnSweep = 1 << 30;

/// Leaves nothing out that covers something. Once a motion has begun, for many threads at once. The stock must outlive it.
class NearPoses {
 public:
  explicit NearPoses(const SweptStock& stock) : stock_(stock) {}

  /// Rows of this motion come next, of the stock as it is.
  void begin(const RuledMotion& motion);
  [[nodiscard]] const Sweep& own() const { return own_; }
  /// Its places in [0, own().last()] as a motion over [0, 1].
  static constexpr int kOwnIntervals = 48;

  /// Adds to `out` every `stride`-th pose that may cover something of `whole`, and, where `parts` are given, of one of them:
  /// the newest sweeps first, of the motion itself up to the place `own_last`. `recent`: of the stock's last sweeps only so
  /// many; 0: of all. `scratch` is the caller's memory.
  void add(const RowFrame& frame, const RowDisc& whole, std::span<const RowDisc> parts, double own_last,
           std::size_t recent, int stride, std::vector<RowDisc>& scratch, std::vector<NearPose>& out) const;

 private:
  /// Axes whose middles lie within `spread` of a place, seen in the frame of a row, and which are tilted by at most `tilt`.
  struct Bundle {
    double x = 0.0, y = 0.0, along = 0.0, spread = 0.0, tilt = 0.0;
  };
  [[nodiscard]] Bundle bundle_of(const RowFrame& frame, const Sweep& sweep, const Sweep::Chunk& chunk,
                                 double tilt) const;
  [[nodiscard]] bool is_beyond(const Bundle& bundle, const RowDisc& disc, double axis_length) const;
  [[nodiscard]] bool is_ever_near(const Sweep& sweep) const;
  void add_sweep(const RowFrame& frame, const RowDisc& whole, std::span<const RowDisc> parts, const Sweep& sweep,
                 int index, double last, int stride, std::vector<RowDisc>& scratch, std::vector<NearPose>& out) const;
  /// Whether a pose may cover something of one of the discs, which lie in `all`; none: of that. Fills all but sweep and pose.
  [[nodiscard]] bool meets(const RowFrame& frame, const Pose& pose, const RowDisc& all, std::span<const RowDisc> discs,
                           NearPose& out) const;

  const SweptStock& stock_;
  Sweep own_;
  std::vector<int> near_;  ///< sweeps that some row of the motion may meet
};

}  // namespace flank::internal
