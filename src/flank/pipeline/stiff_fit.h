/// The stiffest tool that does it.
#pragma once

#include "flank/fit.h"

namespace flank::internal {

/// fit_automatic within the bounds of options.bounds. If they cost more than kStiffnessCost of the coverage and the fit
/// falls short of `least_coverage` for it, slenderness and neck are lifted, and brought back as far as that share
/// allows: the least slenderness that does. A note says so, with the figures.
[[nodiscard]] FlankFitResult fit_stiff(const Target& target, const ToolModel& tool, const FlankFitOptions& options,
                                       double least_coverage, const Progress& progress);

/// Share of the target's area that a stiffer tool may cost.
inline constexpr double kStiffnessCost = 0.005;

}  // namespace flank::internal
