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
  /// By how much less the new motions are to leave at a point of the face than the old ones, mm. Called from several threads at once.
  std::function<double(const Vec3&)> less_mm;
};

struct AimedMotions {
  std::vector<RuledMotion> motions;
  double rms_mm = 0.0, largest_mm = 0.0;  ///< of what they leave less what they are to leave, over points of the face
};

/// Least squares over a smooth change of the rails, of 16 control points each: a motion that followed what no motion of the tool leaves
/// would wave. What of the face the old motions leave by more than four tolerances does not count. Where nothing is asked for, the
/// motions stay what they are. The same bytes for any number of threads.
[[nodiscard]] AimedMotions aimed_motions(const AimProblem& problem);

}  // namespace flank::internal
