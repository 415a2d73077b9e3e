/// Propagation of a line along a target as a rigid axis (paper A 4.3, with Runge-Kutta steps instead of Euler steps of
/// a thousandth). Every step is corrected by least squares back to the distances of the start (MATH section 8, GROW):
/// the first-order form leaves slide and turn nearly open on many tools, the distances over a whole step do not.
#pragma once

#include <vector>

#include "flank/target.h"
#include "flank/vec.h"

namespace flank::internal {

struct PropagationOptions {
  /// >= 5: footpoints along the axis. Four coordinates are corrected by them. More if the target changes often along
  /// it.
  int samples = 24;
  /// > 0: stop if E exceeds this; no unit, a squared angle: 0.1 rad between motion and surface. Raise it to get past a
  /// bump.
  double movability_limit = 1e-2;
  /// Step lengths, > 0, as shares of the target's diagonal, shortest < first < longest. The first is also the length
  /// from which on a step is too short to be refused for its correction. About 30 steps cross a face.
  double first_step_share = 0.01;
  double longest_step_share = 0.04;
  double shortest_step_share = 2e-4;
  /// > 0: a step is halved if its correction is longer than this share of it: at 1 the correction may be as long as the
  /// step itself, but not turn it round.
  double correction_share = 1.0;
  /// >= 0: travel past the border, as a share of the diagonal, so that the tool also finishes the rim.
  double overrun_share = 0.02;
  /// > 0, as a share of the diagonal: a target that has no border after four of them closes on itself (a circle of the
  /// diagonal's size is 3.1 of them round).
  double longest_travel_share = 4.0;
};

/// Why a propagation ended.
enum class PropagationEnd {
  kNotRun,
  kBorder,      ///< no footpoint lies inside the target any more; the overrun was added (the one good end)
  kMovability,  ///< E > movability_limit, or nothing to measure it with
  kStep,        ///< no direction is defined even by the shortest step
  kTravel,      ///< longest_travel_share diagonals were travelled without meeting a border (a closed target)
};

struct Propagation {
  PropagationEnd end = PropagationEnd::kNotRun;
  std::vector<Pose> poses;        ///< first: the line itself
  std::vector<double> travel_mm;  ///< of the middle of the axis, one per pose
  int steps = 0;                  ///< accepted, without the overrun
  double worst_movability = 0.0;
  double worst_drift_mm = 0.0;  ///< root mean square difference of the distances from the start's, inside the target
};

/// Propagates the axis towards `heading` (only the sign of its part along the best velocity counts).
[[nodiscard]] Propagation propagate(const Target& target, const Pose& start, double axis_length, const Vec3& heading,
                                    const PropagationOptions& options = {});

}  // namespace flank::internal
