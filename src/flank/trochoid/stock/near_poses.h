/// Which earlier poses may cover something of a row of rings: most of the time of a measure goes by asking those that do
/// not, so they are left out early, bundle by bundle.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "flank/ruled_motion.h"
#include "flank/trochoid/stock/pose_lanes.h"
#include "flank/trochoid/stock/swept_stock.h"

namespace flank::internal {

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

/// Many such poses, each number in an array of its own; chunks of them follow one another in a sweep.
class SeenPoses {
 public:
  void clear();
  /// The first `count` of these count, of a sweep from the pose `first` on; the others are nowhere.
  void add(const PoseLanes& lanes, std::size_t count, int sweep, std::size_t first);
  [[nodiscard]] std::size_t count() const { return at_[0].size(); }
  [[nodiscard]] NearPose operator[](std::size_t k) const;
  /// x0, y0, dx, dy, h0, dh.
  [[nodiscard]] const double* lane(std::size_t c) const { return at_[c].data(); }

 private:
  std::array<std::vector<double>, 6> at_;
  std::vector<int> sweeps_, firsts_;  ///< of each chunk
};

/// Memory of a caller of NearPoses.
struct NearScratch {
  SeenBundles seen;
  DiscLanes discs;
  std::vector<RowDisc> some;
  std::vector<std::size_t> near;  ///< bundles
};

/// Leaves nothing out that covers something. Once a motion has begun, for many threads at once. The stock must outlive it.
class NearPoses {
 public:
  explicit NearPoses(const SweptStock& stock) : stock_(stock) {}

  /// Rows of this motion come next, of the stock as it is.
  void begin(const RuledMotion& motion);
  [[nodiscard]] const Sweep& own() const { return own_; }
  /// Chunks of sweeps that some row of the motion may meet.
  [[nodiscard]] std::size_t count() const { return firsts_.size(); }
  /// Its places in [0, own().last()] as a motion over [0, 1].
  static constexpr int kOwnIntervals = 48;

  /// Adds to `out` every Sweep::kRough-th pose of the stock's last sweeps, `recent` of them, that may cover something of `whole`: the
  /// newest sweeps first, of the motion itself up to the place `own_last`. `scratch` is the caller's memory.
  void add_roughly(const RowFrame& frame, const RowDisc& whole, double own_last, std::size_t recent,
                   NearScratch& scratch, std::vector<NearPose>& out) const;

  /// The same with every pose of all sweeps that may cover something of one of `parts`, too, which lie in `whole`.
  void add(const RowFrame& frame, const RowDisc& whole, std::span<const RowDisc> parts, double own_last,
           NearScratch& scratch, std::vector<NearPose>& out) const;

  /// One pose, if it is there at that time of the motion and says something of the row, to `out`: the same bits as those of the others.
  void add_pose(const RowFrame& frame, int sweep, int pose, double own_last, std::vector<NearPose>& out) const;

  /// All poses of the bundles of which one may cover something of one of `parts`, in place of what is in `out`: more than add
  /// finds, and sooner.
  void see(const RowFrame& frame, const RowDisc& whole, std::span<const RowDisc> parts, double own_last,
           NearScratch& scratch, SeenPoses& out) const;

 private:
  /// One past the last pose of a bundle that counts.
  [[nodiscard]] std::size_t end_of(std::size_t bundle, double own_last) const;
  /// Whether some row of the motion may meet a part of a sweep: one of its chunks, or all of them.
  [[nodiscard]] bool is_ever_near(const Sweep& sweep, const Sweep::Chunk& part) const;
  void add_bundles_of(const Sweep& sweep, int index);
  /// Adds those of a bundle, as add does; the discs are those that it may reach.
  void add_bundle(const RowFrame& frame, const RowDisc& whole, std::span<const RowDisc> discs, std::size_t bundle,
                  double own_last, std::vector<NearPose>& out) const;
  /// Calls use(bundle) for those of which a pose may cover something of one of `parts`, in their order. Those that the row's disc leaves
  /// are few, and are looked at several at a time.
  template <class Use>
  void for_each_bundle(const RowFrame& frame, const RowDisc& whole, std::span<const RowDisc> parts, double own_last,
                       NearScratch& scratch, const Use& use) const;
  /// Bundles of the motion itself and of the last `recent` sweeps.
  [[nodiscard]] std::size_t count_of(std::size_t recent) const;
  [[nodiscard]] const Sweep& sweep_of(int index) const {
    return index == kOwnSweep ? own_ : stock_.sweeps()[static_cast<std::size_t>(index)];
  }

  const SweptStock& stock_;
  Sweep own_;
  ToolReach tool_;
  /// Chunks of the motion's own sweep, then of those that some of its rows may meet, the newest first: their poses, and where
  /// they begin.
  BundleLanes bundles_;
  std::vector<int> sweeps_;
  std::vector<std::size_t> firsts_;
};

}  // namespace flank::internal
