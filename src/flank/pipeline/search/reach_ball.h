/// The ball that says what a free tool is to reach, and how thin tools may be for it.
#pragma once

#include <optional>

#include "flank/fit.h"
#include "flank/setup/setup.h"
#include "flank/target.h"

namespace flank::internal {

/// Tools thinner than the bounds, if this ball is; not if the user bounds them.
void allow_thin(const FitJob& job, double ball_mm, RadiusBounds& bounds);

/// The bounds that the user gives, or the target's size. A groove takes tools that are thinner than that if it has to.
[[nodiscard]] RadiusBounds bounds_for(const FitJob& job, const Target& target);

/// Three digits: it is shown to people, and written into the command that makes the result again.
[[nodiscard]] double three_digits(double radius_mm);

/// The ball's radius, mm: of the part and of the demand, not of the tool, or a thick one would bring its own excuse. It is that of a
/// cylinder as long as the target is wide (or of the length that is asked for) that is just stiff enough, or of a fillet that the
/// target runs into where that is smaller, and no smaller than tools may be.
[[nodiscard]] double reach_of_part(const Setup& setup, const Target& target, std::optional<double> axis_length_mm,
                                   const RadiusBounds& bounds);
/// The same, unless the job names one.
[[nodiscard]] double demanded_reach(const FitJob& job, const Setup& setup, const Target& target,
                                    const RadiusBounds& bounds);

/// The ball's radius of a cavity's sides, mm: that of the thickest tool that goes through it, or of a fillet that they run into.
[[nodiscard]] double reach_in_gap(const Setup& setup, double gap_mm);

}  // namespace flank::internal
