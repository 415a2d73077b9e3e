/// The search of a fit: starts, number of strips, several targets with one tool.
#pragma once

#include <optional>

#include "flank/fit.h"
#include "flank/pipeline/search/wound_face.h"
#include "flank/setup/setup.h"
#include "flank/setup/targets.h"
#include "flank/tool_request/tool_spec.h"

namespace flank::internal {

/// What is asked of a search beside its job.
struct FitDemand {
  double spare_coverage =
      0.0;  ///< what the estimate has to promise beyond the job's demand, where a judge has seen that much less
  decltype(FlankFitOptions::is_free_line) is_free_line = {};
  bool shank_in_the_way = false;  ///< RadiusBounds has it
};

struct FitSearch {
  std::vector<TargetGroup> targets;
  FlankFitResult fit;                        ///< motions of all groups, one tool
  std::vector<std::size_t> group_of_motion;  ///< index into targets
  std::optional<double> reach_radius_mm;     ///< of the ball that a free tool was asked to reach with
  double open_share = 1.0;                   ///< of the first group's area, that the demanded ball reaches
  double spare_coverage = 0.0;               ///< as search_fit was given it
  bool exact = false;                        ///< tours that no pass makes better (tour_start.h)
  bool limited = false;                      ///< the search ended where the job's effort ends, with its best so far
  ToolModel tool;                            ///< what was known of the tool
  FlankFitOptions options;                   ///< of the fits, but for their strips
  std::optional<WoundFace> wound_face;       ///< the target is half a turn of it
  std::vector<TargetGroup> wound;            ///< all of it; empty without it
  /// The motions that were found, each on its target, to go on from.
  [[nodiscard]] std::vector<FitTask> tasks() const;
  /// What is machined: `targets`, or all that they stand for.
  [[nodiscard]] const std::vector<TargetGroup>& machined() const { return wound.empty() ? targets : wound; }
  /// The motions of a result of this search on what is machined.
  [[nodiscard]] std::vector<RuledMotion> motions_of(const FlankFitResult& result) const;
};

/// Searches. `spec`: the job's tool. Throws UsageError and InputError.
[[nodiscard]] FitSearch search_fit(const FitJob& job, const Setup& setup, const ToolSpec& spec,
                                   const Progress& progress, const FitDemand& demand = {});

}  // namespace flank::internal
