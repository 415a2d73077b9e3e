/// The rings on which a motion is measured row by row: those of the engagement are the same in every row, those of the volume are
/// elsewhere in each.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "flank/trochoid/stock/tool_profile.h"

namespace flank::internal {

/// Material often ends at one height of the tool all along a motion: at the blank's top, or at what the layer above has left.
/// Rings that stay where they are count a whole ring too much or too little there, in every row. Here they move on by a fraction
/// of their distance from row to row, so that the rows together have many times as many heights, and what one counts too much the
/// next ones do not.
class RowRings {
 public:
  /// `asked` (0, or >= 2) rings of the flank at equal steps, the axis' ends included, for the engagement, and `volume` (>= 0) for
  /// the volume, with as many on each round end as are as near to each other, at least one.
  /// Of those for the engagement all but every `every`-th and the axis' ends are asked only where they may engage most.
  RowRings(const RadialFunction& radial, int asked, int volume, int every = 1);

  [[nodiscard]] std::span<const ToolRing> of(std::size_t row) const { return sets_[row * kStep % sets_.size()]; }

 private:
  /// So many sets of rings, which follow one another in leaps: neighbouring rows are far from each other, as are those after them
  /// (both are Fibonacci numbers).
  static constexpr std::size_t kSets = 89, kStep = 55;
  std::vector<std::vector<ToolRing>> sets_;
};

}  // namespace flank::internal
