/// `flank cover --tool catalogue`, or a family of which parameters are open: the tool is chosen for the surface.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flank/pipeline/search/cover_groups.h"
#include "flank/run.h"
#include "flank/tool_request/catalogue.h"
#include "flank/tool_request/tool_spec.h"

namespace flank::internal {

/// Among what a job chooses: the tools of a folder, or a family.
struct ToolChoice {
  std::string folder;                ///< of a catalogue; empty: a family
  std::vector<CatalogueTool> tools;  ///< of the folder, with the job's shank and holder
  ToolSpec family;
};

/// Nothing if the job names one tool. Throws UsageError and InputError for what cannot be chosen from.
[[nodiscard]] std::optional<ToolChoice> tool_choice(const CoverJob& job);

/// Ranks, covers with the best and returns that; result.tool and result.ranking are set. If no tool works that is the one
/// that came nearest, without strips, and result.notes says why.
[[nodiscard]] std::vector<Covered> cover_with_best(const CoverJob& job, const ToolChoice& choice, const Setup& setup,
                                                   Result& result, const Progress& progress);

}  // namespace flank::internal
