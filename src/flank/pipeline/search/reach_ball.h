/// The ball that says what a free tool is to reach, and how thin tools may be for it.
#pragma once

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
/// cylinder as long as the target is wide that is just stiff enough, or of a fillet that the target runs into where that is smaller,
/// and no smaller than tools may be.
[[nodiscard]] double demanded_reach(const FitJob& job, const Setup& setup, const Target& target,
                                    const RadiusBounds& bounds);

}  // namespace flank::internal
