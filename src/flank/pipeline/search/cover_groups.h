/// What covering with one tool and ranking many have in common: targets, what is in the way, and what is done with strips.
#pragma once

#include <vector>

#include "flank/cover.h"
#include "flank/setup/setup.h"
#include "flank/setup/targets.h"

namespace flank::internal {

/// A group with its strips.
struct Covered {
  TargetGroup group;
  CoverResult result;
};

/// How far a tool reaches from a place that it touches, mm, if only what is known of it is counted.
struct ToolExtent {
  double reach_mm = 0.0;
};
[[nodiscard]] ToolExtent extent_of(const Tool& tool);

/// What is in the way of tools of this extent at a group of targets: other faces of the part, and fixtures; for what holds the tool all of
/// the part, the target itself as well.
[[nodiscard]] Obstacles obstacles_of(const CoverJob& job, const Setup& setup, const TargetGroup& group,
                                     const ToolExtent& extent);

/// The job's wishes as options of the search. Throws UsageError for a seed that its strategy has no use for.
[[nodiscard]] CoverOptions options_of(const CoverJob& job);

}  // namespace flank::internal
