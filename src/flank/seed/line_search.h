/// Local search for a better movable line near a given one (paper A 4.2: samples around both ends, the best is kept;
/// here the same four degrees of freedom are minimised instead of sampled).
#pragma once

#include "flank/seed/movability.h"
#include "flank/vec.h"

namespace flank::internal {

struct LineSearchOptions {
  /// >= 5, along the axis: four shifts are to be found. More for an axis over which the target changes often.
  int samples = 24;
  /// >= 0. 0: the line stays as it is.
  int iterations = 12;
  /// >= 0: how far an end may move, as a share of the target's diagonal. Larger for a line that was drawn roughly; then
  /// it may end at another movable line than the one meant.
  double radius_share = 0.01;
};

struct LineSearch {
  Pose pose;                 ///< the best line
  Movability before, after;  ///< of the given line, of the best one
  double shift_mm = 0.0;     ///< of the end that moved farther
  int evaluations = 0;       ///< of the form
};

/// Levenberg-Marquardt on <n_j, v(s_j)> over the shifts of both ends across the axis. Deterministic; never returns a
/// line that is less movable, or whose footpoints count less, than the given one.
[[nodiscard]] LineSearch search_line(const Target& target, const Pose& start, double axis_length,
                                     const LineSearchOptions& options = {});

}  // namespace flank::internal
