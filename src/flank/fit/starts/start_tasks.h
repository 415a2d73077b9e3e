/// The starts of a search: ruled motions laid over a target at several skews and radii, in bands side by side, cut where other
/// faces are in the way.
#pragma once

#include <initializer_list>
#include <vector>

#include "flank/fit.h"
#include "flank/seed/ruled_start.h"

namespace flank::internal {

/// All starts in a chart; `ways`: with lines across the chart, along it (swapped), or both. MATH section 7.
[[nodiscard]] std::vector<RuledStart> enumerate_starts(const Chart& chart, const ToolModel& tool,
                                                       const FlankFitOptions& options,
                                                       std::initializer_list<bool> ways);

/// A start and its motions, one per strip, bands side by side, all of one axis length.
struct LaidStart {
  RuledStart start;
  std::vector<FitTask> tasks;
};

/// The start laid over the target; with options.obstacles, cut to what is free. No tasks where no line is. A free tool leans away from
/// the target, as a cone, by as little as it must for something to hold it (FlankFitOptions::is_free_line).
[[nodiscard]] LaidStart lay_start(const Target& target, const Chart& chart, const RuledStart& start,
                                  const ToolModel& tool, const FlankFitOptions& options);

}  // namespace flank::internal
