/// Which end of an axis is the upper one, where something has to hold the tool.
#pragma once

#include <vector>

#include "flank/fit.h"

namespace flank::internal {

/// The motion with tip and upper end of its axis exchanged.
[[nodiscard]] RuledMotion turned_over(const RuledMotion& motion);

/// Share of a motion, by samples, at which a rod in the axis, continued beyond its upper end, runs into something
/// (FlankFitOptions::is_free_line): as thick as the shank if that is in the way, else a line.
[[nodiscard]] double unheld_share(const RuledMotion& motion, const FlankFitOptions& options);
/// The largest of several motions of a tool, of a rod in the axis as the judge has it (clearance.h, HoldReport::axis).
[[nodiscard]] double unheld_share(const std::vector<RuledMotion>& motions, const RadialFunction& tool,
                                  const FlankFitOptions& options);

/// The tasks as they are, or all of them turned over where their axes, continued beyond the tip, run into less than beyond the upper end: a
/// chart knows nothing of what holds a tool.
void hold_from_free_end(const FlankFitOptions& options, std::vector<FitTask>& tasks);

}  // namespace flank::internal
