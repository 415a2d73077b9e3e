/// The search of a fit: starts, sides of open sheets, number of strips, several targets with one tool.
#pragma once

#include <functional>

#include "flank/pipeline/fit_job.h"
#include "flank/setup/targets.h"
#include "flank/toolbox/tool_command.h"

namespace flank::internal {

struct FitSearch {
  std::vector<TargetGroup> targets;
  FlankFitResult fit;                        ///< motions of all groups, one tool
  std::vector<std::size_t> group_of_motion;  ///< index into targets
};

/// faces: of the targets; checks: the faces that are no targets and must not be entered.
[[nodiscard]] FitSearch search_fit(const FitJob& job, const Part& part, const std::vector<int>& faces,
                                   const std::vector<int>& checks, const ToolSpec& spec,
                                   const std::function<RadiusBounds(const FitJob&, double diagonal)>& bounds,
                                   const Progress& progress);

}  // namespace flank::internal
