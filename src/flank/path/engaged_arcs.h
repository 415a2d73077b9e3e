/// Which parts of a tool's circles are in the material, pose by pose.
#pragma once

#include <vector>

namespace flank::internal {

/// Of the contact circle at one height. Angles are counted about the tool's axis, against the turn of a right-hand spindle, from
/// the direction in which the circle goes across the axis, rad.
struct EngagedArc {
  int ring = 0;  ///< of `heights`
  double from = 0.0, to = 0.0;
  [[nodiscard]] double angle() const { return to - from; }
};

/// Of every pose of every strip, by ascending rings.
struct PathArcs {
  std::vector<double> heights;  ///< s of the rings, mm, ascending; none: nothing is known
  std::vector<std::vector<std::vector<EngagedArc>>> strips;
};

}  // namespace flank::internal
