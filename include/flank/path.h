/// Path: poses in strips, pure data. A pose is joined to the next one by a straight line of the tip and of the
/// unnormalised axis vector.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "flank/vec.h"

namespace flank {

/// One pass of the flank. Within a strip the tool cuts; between strips it moves clear (links are not planned here).
struct Strip {
  int id = 1;
  std::string kind = "flank";  ///< flank, side, front, back, entry, ramp, plunge, link, ...
  std::string face;            ///< the target, e.g. "F1" or "F1,F3"
  /// In the order of machining, at least one; every axis a unit vector.
  std::vector<Pose> poses;
  int layer = 0;  ///< of a cavity that is cut in layers, from 1 at the top; 0: of none
};

/// Strips in the order of machining. How it is written: docs/schema/path.md.
struct Path {
  std::vector<Strip> strips;
  [[nodiscard]] std::size_t pose_count() const {
    std::size_t n = 0;
    for (const Strip& s : strips) n += s.poses.size();
    return n;
  }
};

/// How sharply the paths of the two ends of the axis bend: the least radius of curvature along each, mm; infinite for a
/// path without a bend.
struct BendRadii {
  double tip_mm = std::numeric_limits<double>::infinity();
  double holder_end_mm = std::numeric_limits<double>::infinity();  ///< of the axis, s = L
  [[nodiscard]] double least_mm() const { return tip_mm < holder_end_mm ? tip_mm : holder_end_mm; }
};

}  // namespace flank
