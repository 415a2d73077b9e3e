/// The least slender tool, where the bounds on stiffness cost too much.
#pragma once

#include "flank/fit.h"

namespace flank::internal {

/// What a fit within the bounds of options.bounds is worth when they are lifted. `within` fell short of what was asked:
/// slenderness and neck are lifted, and if that covers more than kStiffnessCost, the slenderness is brought back as far as
/// that share allows. A note says so, with the figures. `within` itself if the tool is given, or if nothing is gained.
[[nodiscard]] FlankFitResult soften(const Target& target, const ToolModel& tool, const FlankFitOptions& options,
                                    FlankFitResult within, const Progress& progress);

/// Share of the target's area that a stiffer tool may cost.
inline constexpr double kStiffnessCost = 0.005;

}  // namespace flank::internal
