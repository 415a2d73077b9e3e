/// Propagation of a line along a target as a rigid axis (paper A 4.3, with Runge-Kutta steps instead of Euler steps of
/// a thousandth). Every step is corrected by least squares back to the distances of the start (MATH section 8, GROW):
/// the first-order form leaves slide and turn nearly open on many tools, the distances over a whole step do not.
#pragma once

#include <vector>

#include "flank/target.h"
#include "flank/vec.h"

namespace flank::internal {

struct PropagationOptions {
  int samples = 24;                ///< footpoints along the axis
  double movability_limit = 1e-2;  ///< stop where E exceeds this (0.1 rad between motion and surface)
  double first_step_share = 0.01;  ///< step lengths, as shares of the target's diagonal
  double longest_step_share = 0.04;
  double shortest_step_share = 2e-4;
  double correction_share = 1.0;  ///< a step is halved if its correction is longer than this share of it
  double overrun_share = 0.02;    ///< travel past the border, as a share of the diagonal
  double longest_travel_share = 4.0;
};

/// Why a propagation ended.
enum class PropagationEnd {
  kNotRun,
  kBorder,      ///< no footpoint lies inside the target any more; the overrun was added
  kMovability,  ///< E > movability_limit, or nothing to measure it with
  kStep,        ///< no direction is defined even by the shortest step
  kTravel,      ///< longest_travel_share diagonals were travelled without meeting a border (a closed target)
};

struct Propagation {
  PropagationEnd end = PropagationEnd::kNotRun;
  std::vector<Pose> poses;        ///< first: the line itself
  std::vector<double> travel_mm;  ///< of the middle of the axis, one a pose
  int steps = 0;                  ///< accepted, without the overrun
  double worst_movability = 0.0;
  double worst_drift_mm = 0.0;  ///< root mean square difference of the distances from the start's, inside the target
};

/// Propagates the axis towards `heading` (only the sign of its part along the best velocity counts).
[[nodiscard]] Propagation propagate(const Target& target, const Pose& start, double axis_length, const Vec3& heading,
                                    const PropagationOptions& options = {});

}  // namespace flank::internal
