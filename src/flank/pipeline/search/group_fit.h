/// Groups of faces that are connected, each with as many strips as it takes, all with one tool.
#pragma once

#include <vector>

#include "flank/fit.h"
#include "flank/setup/targets.h"

namespace flank::internal {

/// The largest number of strips that "as many as the tolerance needs" tries.
inline constexpr int kMostStrips = 12;

/// What is asked of groups.
struct GroupDemand {
  int strips = 0;                 ///< of each; 0: as many as it takes
  int most_strips = kMostStrips;  ///< where it takes as many as it takes
  bool soften = true;             ///< a tool more slender than the bounds allow is tried where they cost too much
  std::vector<double> wanted;     ///< of each: the estimate of its covered share, in [0, 1], with which it is done
};

struct GroupFits {
  FlankFitResult fit;                        ///< motions of all groups, one tool
  std::vector<std::size_t> group_of_motion;  ///< index into groups
};

/// The first large group finds the tool. Other large ones: one strip each with it, or with all polished together, if that does what is
/// wanted; else as many as each takes, and polished together only if that does not do it. Groups of less than a tenth of the
/// largest one's area take the tool as it is, and are covered as far as the whole needs them. Obstacles are those of the groups.
[[nodiscard]] GroupFits fit_groups(const std::vector<TargetGroup>& groups, const ToolModel& tool,
                                   const FlankFitOptions& options, const GroupDemand& demand, const Progress& progress);

}  // namespace flank::internal
