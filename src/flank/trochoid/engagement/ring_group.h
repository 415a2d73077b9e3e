/// Rings that lie near to each other are looked at together first: what none of them needs is left out at once.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "flank/trochoid/stock/pose_filter.h"
#include "flank/vec.h"

namespace flank::internal {

/// An arc of a ring that is in the material, radians from the direction of motion, towards u x motion.
struct Arc {
  double low = 0.0, high = 0.0;
};

/// An arc and the ring that it is on, by its index.
struct RingArc {
  std::size_t ring;
  double motion_angle;
  Arc arc;
};

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
    constexpr double kRoundingRoom = 1.02;
    const Vec3 centre = box.center();
    return {centre.x(), centre.y(), kRoundingRoom * 0.5 * box.diagonal() + bow, low, high};
  }
};

/// A disc that holds these arcs of rings of a tool of this largest radius, and small ones, into `parts`, that hold them together.
[[nodiscard]] RowDisc discs_of(std::span<const RingArc> arcs, std::span<const ToolRing> rings, double largest_mm,
                               std::vector<RowDisc>& parts);

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

/// A rough look leaves too much open, never too little, and about as much too much as at the rings beside. So a ring between two
/// that were looked at closely needs no close look where the rough one, less what it left too much at both of these, is no more
/// than the largest engagement of the row.
class WantedRings {
 public:
  /// Those that are not between others, to begin with.
  void begin(std::span<const ToolRing> rings);
  [[nodiscard]] bool operator[](std::size_t ring) const { return wanted_[ring] != 0; }
  /// Those between others that may engage more than all of them, in place of these: by what a rough look left open of each ring,
  /// radians, and what the close look found. False: there are none.
  [[nodiscard]] bool go_on(std::span<const ToolRing> rings, const std::function<double(std::size_t)>& rough,
                           std::span<const RingArc> found);

 private:
  std::vector<char> wanted_;
  std::vector<double> found_;  ///< radians, of each ring
};

}  // namespace flank::internal
