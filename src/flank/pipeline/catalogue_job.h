/// `flank cover --tool catalogue`, or a family of which parameters are open: the tool is chosen for the surface.
#pragma once

#include <optional>
#include <vector>

#include "flank/pipeline/cover_groups.h"
#include "flank/toolbox/catalogue.h"
#include "flank/toolbox/tool_command.h"

namespace flank::internal {

/// Among what a job chooses: the tools of a folder, or a family.
struct ToolChoice {
  std::string folder;                ///< of a catalogue; empty: a family
  std::vector<CatalogueTool> tools;  ///< of the folder, with the job's shank and holder
  ToolSpec family;
};

/// Nothing where the job names one tool. Throws UsageError and InputError for what cannot be chosen from.
[[nodiscard]] std::optional<ToolChoice> tool_choice(const CoverJob& job);

/// Ranks, covers with the best and returns that; outcome.tool, ranking and ranking_text are set. Where no tool works
/// that is the one that came nearest, without strips, and outcome.notes says why.
[[nodiscard]] std::vector<Covered> cover_with_best(const CoverJob& job, const ToolChoice& choice, const Part& part,
                                                   const std::vector<int>& faces, FitOutcome& outcome,
                                                   const Progress& progress);

}  // namespace flank::internal
