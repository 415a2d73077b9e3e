/// Passes of a tool's tip sphere up a side of a channel, from the corner at its floor.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "flank/path.h"
#include "flank/wheel/point/channel_rows.h"

namespace flank::internal {

/// A pass, place by place along the channel; absent where it must not run or need not.
using PoseRow = std::vector<std::optional<Pose>>;

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

/// Stretches of poses that are there, as strips; each other row the other way round; split where they turn too sharply.
void add_strips(std::vector<PoseRow> rows, const RadialFunction& radial, const PointOptions& options,
                const std::string& kind, const std::string& face, std::vector<Strip>& out);

}  // namespace flank::internal
