/// The tools that a search polished and did not choose: what it costs to have one as stiff.
#pragma once

#include "flank/fit.h"

namespace flank::internal {

/// Slenderness of flank and shank, as the bounds count it. Infinite for a tool whose radius is not positive everywhere.
[[nodiscard]] double slenderness_of(const RadialFunction& radial, const RadiusBounds& bounds);

[[nodiscard]] RejectedTool rejected_tool(const RadialFunction& radial, std::size_t strips,
                                         const CoverageEstimate& estimate, const RadiusBounds& bounds);

/// Adds a result that was not chosen, with those that it had rejected, to those of the one that was. One without a
/// motion is none.
void add_rejected(FlankFitResult& chosen, const FlankFitResult& beaten, const RadiusBounds& bounds);

/// Tells what was found (Progress::found).
void tell_found(const Progress& progress, const CoverageEstimate& estimate, double tolerance_mm);

}  // namespace flank::internal
