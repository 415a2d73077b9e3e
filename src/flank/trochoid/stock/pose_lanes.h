/// Poses and bundles of poses against the discs of a row, several at a time (near_poses.h). All of it errs on the side of what
/// covers something.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "flank/base/parallel.h"
#include "flank/trochoid/stock/swept_stock.h"

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

/// Of a tool: heights and largest radius, the length of its axis, and how far it reaches from its middle along it, mm.
struct ToolReach {
  double low = 0.0, high = 0.0, largest = 0.0, length = 0.0, half = 0.0;
};

/// Poses that stand together in a stock's sweeps, each coordinate in an array of its own.
struct BundleLanes {
  std::array<std::vector<double>, 7>
      at;  ///< middle of the axes, the first axis, and how far other middles are from it, mm
  /// The pose that stands for each of them, as Sweep has its lanes, and how far its others may be from that at any height of
  /// the tool, mm.
  std::array<std::vector<double>, 7> poses;
  /// Of a tool that reaches so many lengths of its axis past its ends.
  void add(const Sweep::Chunk& chunk, const Vec3& axis, double past_ends);
  void clear();
  [[nodiscard]] std::size_t count() const { return at[0].size(); }
};

/// The same in the frame of a row, and which of them the row's disc leaves.
struct SeenBundles {
  std::vector<double> x, y, along, tilt, beyond;
  /// The first `count` bundles.
  void look(const RowFrame& frame, const ToolReach& tool, const BundleLanes& bundles, std::size_t count,
            const RowDisc& whole);
};

/// Discs, each number in an array of its own.
struct DiscLanes {
  std::array<std::vector<double>, 5> at;  ///< as RowDisc has them
  std::vector<std::int64_t> met;
  void take(std::span<const RowDisc> discs);
  /// Those that bundle k may reach, of discs that were taken, into `some`.
  void meet(const SeenBundles& seen, std::size_t k, double spread, const ToolReach& tool,
            std::span<const RowDisc> discs, std::vector<RowDisc>& some);
};

/// Poses that follow one another in a sweep.
struct PoseLanes {
  static constexpr std::size_t kCount = Sweep::kChunk;
  using Doubles = std::array<double, kCount>;
  using Floats = std::array<float, kCount>;
  Doubles x0, y0, dx, dy, h0, dh;  ///< as NearPose has them
  Floats from_x, from_y, by_x, by_y,
      per_by2;  ///< where an axis begins in the plane, how far it goes on, and 1 / its length^2
  Floats forward, lean_x, lean_y, lean;  ///< share of the axis along the row's, its part across, at least its length
  Floats spread;                         ///< how far the poses that it stands for may be from it, mm
  Floats below;                          ///< height of the row's tip over its own
  std::array<std::int32_t, kCount> hit;  ///< not 0: it may cover something

  void look(const RowFrame& frame, const ToolReach& tool, const Sweep& sweep, std::size_t first);
  /// Every Sweep::kRough-th pose, from one of these on.
  void look_roughly(const RowFrame& frame, const ToolReach& tool, const Sweep& sweep, std::size_t first);
  /// Poses that stand for bundles, 1 to kCount of them; the last one again up to that.
  void look(const RowFrame& frame, const ToolReach& tool, const BundleLanes& bundles,
            std::span<const std::size_t> which);
  /// Where their axes meet the plane of a row, and nothing else.
  void project(const RowFrame& frame, const Sweep& sweep, std::size_t first);
  /// Axes that lean so far say nothing.
  [[nodiscard]] bool is_near(std::size_t k) const { return dh[k] > 0.0 && dh[k] <= 2.0; }
  /// Whether some of them may cover something of one of the discs, which lie in `all`; none: of that.
  [[nodiscard]] bool meets(const ToolReach& tool, const RowDisc& all, std::span<const RowDisc> discs);
};

}  // namespace flank::internal
