/// The least slender tool, where the bounds on stiffness cost too much; and what every step of stiffness costs.
#pragma once

#include <vector>

#include "flank/fit.h"

namespace flank::internal {

/// What a fit within the bounds of options.bounds is worth when they are lifted. `within` fell short of what was asked:
/// slenderness and neck are lifted, and if that is better (fit/rank.h), the slenderness is brought back as far as it stays so. A note says so, with the figures. `within` itself if the tool is given, or if nothing is gained.
[[nodiscard]] FlankFitResult relax_stiffness_bounds(const Target& target, const ToolModel& tool,
                                                    const FlankFitOptions& options, FlankFitResult within,
                                                    const Progress& progress);

/// Free tools of other slendernesses than that of the one that was `found`: a ladder of them, as far as the tool's bounds
/// let it go, each fitted from the next one nearer to the found one, or, where that loses its way, from the next one
/// farther; the stiffer ones first, the nearest first. The planner's figures of each are in its result. `tasks` name the
/// target of each of the found motions.
[[nodiscard]] std::vector<FlankFitResult> stiffness_ladder(const std::vector<FitTask>& tasks,
                                                           const FlankFitResult& found, const ToolModel& tool,
                                                           const FlankFitOptions& options, const Progress& progress);

/// Adds a note to a fit with a free tool that is more slender than options.bounds asked: by how much, and what the best of
/// the stiffer ones that were tried covers. The bound is a soft term: where nearly all of the face is covered it may give
/// way a little, and nobody would know.
void note_slenderness(const ToolModel& tool, const FlankFitOptions& options, FlankFitResult& fit);

}  // namespace flank::internal
