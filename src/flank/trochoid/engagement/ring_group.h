/// Rings that lie near to each other are looked at together first: what none of them needs is left out at once.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "flank/trochoid/engagement/pose_filter.h"
#include "flank/vec.h"

namespace flank::internal {

/// One past the last ring that is near enough to the first of them, and of the same part of the tool.
[[nodiscard]] std::size_t end_of_group(std::span<const ToolRing> rings, std::size_t first, double height_mm);

/// One at least.
[[nodiscard]] RingGroup group_of(std::span<const ToolRing> rings);

/// Places of a row, in its frame, and the heights of their rings.
struct OpenPart {
  Box3 box;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void add(const ToolRing& ring, const Vec3& place) {
    box.add(place);
    low = std::min(low, ring.z), high = std::max(high, ring.z);
  }
  /// That holds them, and `bow` more.
  [[nodiscard]] RowDisc disc(double bow) const {
    constexpr double kSpare = 1.02;
    const Vec3 centre = box.center();
    return {centre.x(), centre.y(), kSpare * 0.5 * box.diagonal() + bow, low, high};
  }
};

/// What is open of several rings, seen along the axis: sectors that hold it together.
class OpenSectors {
 public:
  void clear() { sectors_.clear(); }
  /// Radians in the frame of the row; low < high.
  void add(double low, double high);
  /// On a circle, into `out`.
  void arcs_on(double radius, std::vector<OpenArc>& out) const;

 private:
  struct Sector {
    double low = 0.0, high = 0.0;
  };
  std::vector<Sector> sectors_;
};

}  // namespace flank::internal
