/// Targets that other faces hide: nothing but time would come of a search there.
#pragma once

#include <string>

#include "flank/fit.h"

namespace flank::internal {

/// Share of the target's area, in [0, 1], that a ball of options.reach_radius_mm can touch, by the samples that rank
/// candidates; 1 if neither another face nor a corner of the target is in the way.
[[nodiscard]] double reachable_share(const Target& target, const FlankFitOptions& options);

/// Share of the target's area where a tool that touches it could be held: in some direction along the surface, or leaning away from it, a line
/// is free (FlankFitOptions::is_free_line). 1 where nothing is said of lines.
[[nodiscard]] double holdable_share(const Target& target, const FlankFitOptions& options);

/// The largest ball, no larger than radius_mm, that can touch half of the target or more, by the obstacles and the tolerance of
/// the options: who machines a groove, or the wall of a slot, wants a tool that fits into it. radius_mm where hardly any does.
[[nodiscard]] double ball_with_room(const Target& target, const FlankFitOptions& options, double radius_mm);

/// Options of a search where hardly any of the target can be reached: one quick strip, so that there is something to look at.
[[nodiscard]] FlankFitOptions scouting_options(FlankFitOptions options);

/// Below this share of the area nobody can reach anything that is worth a tool.
inline constexpr double kHardlyAny = 0.05;

/// What is said of it.
[[nodiscard]] std::string out_of_reach_note(double share, const FlankFitOptions& options);
[[nodiscard]] std::string not_holdable_note(double share);

}  // namespace flank::internal
