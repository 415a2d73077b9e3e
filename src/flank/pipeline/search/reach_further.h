/// What nobody demanded and the tool that was found can do all the same: places that the demanded ball does not touch.
#pragma once

#include <vector>

#include "flank/fit.h"

namespace flank::internal {

/// A search is done when it covers what a ball of the demand touches; a tool that is thinner than this ball may finish more of
/// the whole targets, and whether its motion happens to do so is chance: a looser tolerance would cover less than a tight one.
/// So one more pass draws the motions of what was `found` to all that the tool's own balls touch. Taken if it covers more of
/// the whole and gives up nothing of what was asked; else `found` itself, as where it enters something, or where next to nothing
/// of what these balls touch is left. `tasks`: the targets of the motions and what is in their way.
[[nodiscard]] FlankFitResult reach_further(const std::vector<FitTask>& tasks, const FlankFitResult& found,
                                           const ToolModel& tool, const FlankFitOptions& options,
                                           const Progress& progress);

}  // namespace flank::internal
