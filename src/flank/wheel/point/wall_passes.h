/// Passes of a tool's tip sphere up a side of a channel, from the corner at its floor.
#pragma once

#include <functional>
#include <vector>

#include "flank/wheel/point/channel_rows.h"
#include "flank/wheel/point/pass_strips.h"

namespace flank::internal {

struct WallWork {
  const FloorChannel& channel;
  const ChannelRows& rows;
  const TipRoom& room;
  const PointOptions& options;
  /// The axis at a row, from the outermost place, 0, inwards across the channel, to 1.
  std::function<Vec3(std::size_t row, double inwards)> axis;
  bool at_first = true;  ///< the first side, else the second
};

/// From the corner on upwards, a scallop apart, as far as places of the side are not finished and the tool has room. Passes without a
/// pose are left out.
[[nodiscard]] std::vector<PoseRow> wall_rows(const WallWork& work);

}  // namespace flank::internal
