/// Axes beside the sides of a channel, leant towards them.
#pragma once

#include <vector>

#include "flank/wheel/point/tip_room.h"

namespace flank::internal {

/// Turns the axes of each row of poses, empty where there is no room, about the way of the channel: those at its ends towards
/// their side as far as the tool has room, so that the flank comes as near to the side as the tip does, those in between less,
/// and the middle one not. From row to row the turns change slowly. An axis whose turn has no room keeps what it had.
void lean_to_sides(std::vector<std::vector<Pose>>& rows, const TipRoom& room);

}  // namespace flank::internal
