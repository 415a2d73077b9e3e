/// Walls in a row by a given cylinder or cone: a tour of them before anything is searched.
#pragma once

#include "flank/pipeline/search/group_fit.h"
#include "flank/setup/setup.h"

namespace flank::internal {

struct ToursOrFits {
  GroupFits found;
  bool exact = false;  ///< tours of walls along which a straight flank touches all along: no pass makes them better
};

/// As fit_groups; where each group is walls in a row and the tool is given with a straight meridian, a tour of each is looked at first
/// and taken if it does what is wanted. If it does not, it is what the search has to beat.
[[nodiscard]] ToursOrFits fit_groups_after_tours(const Setup& setup, const std::vector<TargetGroup>& groups,
                                                 const ToolModel& tool, const FlankFitOptions& options,
                                                 const GroupDemand& demand, const Progress& progress);

}  // namespace flank::internal
