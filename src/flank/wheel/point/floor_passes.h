/// Passes of a tool's tip sphere over the floor of a channel (docs/MATH.md, section 14): point contact.
#pragma once

#include <string>
#include <vector>

#include "flank/path.h"
#include "flank/radial_function.h"
#include "flank/wheel/point/channel.h"

namespace flank::internal {

/// Strips of kind "floor" from the first side to the second, and of kind "wall" up both sides from there as far as they are not finished;
/// each other one runs the other way round. The outermost floor pass touches floor and side at once. Before and behind the sides the
/// floor is taken to its border. A pose whose flank would enter something is left out, and a strip ends there. Empty where the sides do
/// not stand on the floor.
[[nodiscard]] std::vector<Strip> point_passes(const FloorChannel& channel, const RadialFunction& radial,
                                              const PointOptions& options, const std::string& floor,
                                              const std::string& first, const std::string& second);

/// The narrowest place of a channel's floor between the sides' lines, mm, but for a tenth of its length; 0 where they do not stand on it.
[[nodiscard]] double channel_width(const FloorChannel& channel, const RadialFunction& radial);

}  // namespace flank::internal
