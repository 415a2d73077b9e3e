/// Poses as strips that a machine can run.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "flank/path.h"
#include "flank/radial_function.h"
#include "flank/wheel/point/channel.h"
#include "flank/wheel/point/tip_room.h"

namespace flank::internal {

/// A pass, place by place along the channel; absent where it must not run or need not.
using PoseRow = std::vector<std::optional<Pose>>;

constexpr double kShortestStripMm = 1.0;  ///< strips that are shorter are not worth a link

/// The strip; in pieces where it turns too sharply, none of which begins where another one ends. Pieces that are not worth a link are left
/// out.
void add_strip(Strip strip, const RadialFunction& radial, const PointOptions& options, std::vector<Strip>& out);

/// Turns axes towards those of their neighbours where a strip turns too sharply, as far as they have room there. `is_free`: whether a pose
/// has, in place of the one with that number.
void steady(Strip& strip, const std::function<bool(std::size_t, const Pose&)>& is_free, const RadialFunction& radial,
            const PointOptions& options);

/// Stretches of poses that are there, as strips, with steady axes; each other row the other way round.
void add_strips(std::vector<PoseRow> rows, const TipRoom& room, const RadialFunction& radial,
                const PointOptions& options, const std::string& kind, const std::string& face, std::vector<Strip>& out);

/// With no more poses than joining them straight asks for: tip and upper end of the axis stay within `chord_mm` of where they were.
[[nodiscard]] Strip thinned(const Strip& strip, double axis_length, double chord_mm);

}  // namespace flank::internal
