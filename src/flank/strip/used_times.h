/// The part of a motion that machines.
#pragma once

#include <vector>

#include "flank/radial_function.h"
#include "flank/ruled_motion.h"
#include "flank/target.h"

namespace flank::internal {

/// Times of a motion.
struct TimeRange {
  double first = 0.0, last = 1.0;
};

/// For every motion the shortest range of times without which some place of the targets would lose its contact within
/// the tolerance, and a hundredth of it more at both ends. What a motion does before and after, where a fit lets it hook
/// and plunge, machines nothing. A motion without any contact keeps all of its time.
[[nodiscard]] std::vector<TimeRange> used_times(const std::vector<RuledMotion>& motions, const RadialFunction& tool,
                                                const std::vector<const Target*>& targets, double tolerance_mm);

}  // namespace flank::internal
