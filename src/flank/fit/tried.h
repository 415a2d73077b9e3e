/// The tools that a search tried: what it costs to have one as stiff.
#pragma once

#include "flank/fit.h"

namespace flank::internal {

/// Slenderness of flank and shank, as the bounds count it. Infinite for a tool whose radius is not positive everywhere.
[[nodiscard]] double slenderness_of(const RadialFunction& radial, const RadiusBounds& bounds);

[[nodiscard]] TriedTool tried_tool(const RadialFunction& radial, std::size_t strips, const CoverageEstimate& estimate,
                                   const RadiusBounds& bounds);

/// Adds a result that was not chosen, and what was tried for it, to what was tried for the one that was. One without a
/// motion is none.
void add_tried(FlankFitResult& chosen, const FlankFitResult& beaten, const RadiusBounds& bounds);

/// Tells what was found (Progress::found).
void tell_found(const Progress& progress, const CoverageEstimate& estimate, double tolerance_mm);

}  // namespace flank::internal
