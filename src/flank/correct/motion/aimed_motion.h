/// Motions moved so that a tool leaves on a face what it is asked to leave there (docs/algorithms/correct.md).
#pragma once

#include <functional>
#include <vector>

#include "flank/radial_function.h"
#include "flank/ruled_motion.h"
#include "flank/target.h"

namespace flank::internal {

struct AimProblem {
  const Target* target = nullptr;    ///< not owned
  std::vector<RuledMotion> motions;  ///< the old ones, side by side
  RadialFunction tool;               ///< given: it stays as it is
  double tolerance_mm = 0.01;
  /// What the machine adds to what a motion, by its place among them, leaves at a point of the face, mm. Called from several threads at
  /// once.
  std::function<double(const Vec3&, std::size_t)> added_mm;
};

struct AimedMotions {
  std::vector<RuledMotion> motions;
  /// Over points of the face: what is left with what the machine adds, less what the old motions leave without it.
  double rms_mm = 0.0, largest_mm = 0.0;
};

/// Least squares over a smooth change of the rails, of 16 control points each: a motion that followed what no motion of the tool leaves
/// would wave. What of the face the old motions leave by more than four tolerances does not count. Where two of them overlap, the one
/// that leaves the least counts, with what the machine adds to it. Where nothing is asked for, the
/// motions stay what they are. The same bytes for any number of threads.
[[nodiscard]] AimedMotions aimed_motions(const AimProblem& problem);

}  // namespace flank::internal
