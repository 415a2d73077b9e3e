/// A start that the user gives as one line (`--start`): the line is improved locally, then propagated both ways over
/// the target (paper A 4.2, 4.3).
#pragma once

#include <string>

#include "flank/ruled_motion.h"
#include "flank/seed/line_search.h"
#include "flank/seed/propagate.h"

namespace flank::internal {

struct LineStartOptions {
  LineSearchOptions search;
  PropagationOptions propagation;
  /// >= 4, per rail of the motion. As the first pass of a fit has it (polish_stage); more are lost there.
  int control_points = 24;
};

enum class LineStartStatus {
  kNotRun,
  kBorderToBorder,  ///< both propagations reached the border of the target
  kClosed,          ///< neither met a border: the target closes on itself
  kPartial,         ///< a propagation stopped before the border; the motion covers what it reached
  kNoMotion,        ///< the line cannot move at all (movability above the limit, or all its footpoints on the border)
};

struct LineStartReport {
  LineStartStatus status = LineStartStatus::kNotRun;
  std::string message;
  PropagationEnd backward = PropagationEnd::kNotRun, forward = PropagationEnd::kNotRun;
  int backward_steps = 0, forward_steps = 0;
  double movability_before = 0.0, movability_after = 0.0;  ///< of the line, before and after the local search
  double worst_movability = 0.0;                           ///< along the motion
  double worst_drift_mm = 0.0;    ///< of the distances along the motion, root mean square over the axis
  double shift_mm = 0.0;          ///< how far the search moved an end of the line
  double travel_mm = 0.0;         ///< of the middle of the axis
  double mean_distance_mm = 0.0;  ///< of the line from the target, negative on the material's side
};

struct LineStart {
  RuledMotion motion;  ///< meaningless (no poses) if the status is kNoMotion
  LineStartReport report;
};

/// +1: the line lies on the machining side of the target, -1: on the other side (mean of the signed distances that
/// count).
[[nodiscard]] int side_of_line(const Target& target, const Pose& pose, double axis_length);

/// Motion over the target from the line `start`, from border to border and a little beyond. Works on either side of the
/// target; for a fit the target's machining side must be the line's (side_of_line).
[[nodiscard]] LineStart start_from_line(const Target& target, const Pose& start, double axis_length,
                                        const LineStartOptions& options = {});

}  // namespace flank::internal
