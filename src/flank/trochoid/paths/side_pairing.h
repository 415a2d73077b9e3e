/// Which places of both side paths a front joins.
#pragma once

#include <vector>

#include "flank/trochoid/paths/side_path.h"

namespace flank::internal {

/// Places of the second path for places of the first: right across the direction of motion where there is such a place, and
/// always forwards. Where the sides wind, a place may have several that lie right across from it, or none: the least sum of the
/// squared sines of the skew, over all pairings of a grid in which neither is more than three times as fast as the other
/// (dynamic programming), says which one it is, and what stands in for it.
class SidePairing {
 public:
  /// As far as `beyond_mm` before and behind both paths; from there on both go equally fast.
  SidePairing(const SidePath& from, const SidePath& to, double beyond_mm);

  /// The place of the second path for x of the first one, mm. Grows with x.
  [[nodiscard]] double at(double x) const;

 private:
  double first_ = 0.0, step_ = 1.0;
  std::vector<double> place_;  ///< at first_ + k step_
};

}  // namespace flank::internal
