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

/// The motions of a start, one per strip, bands side by side, all of one axis length; with options.obstacles, cut to what is
/// free. Empty where no line is.
[[nodiscard]] std::vector<FitTask> make_tasks(const Target& target, const Chart& chart, const RuledStart& start,
                                              const ToolModel& tool, const FlankFitOptions& options);

}  // namespace flank::internal
