/// Poses as strips that a machine can run.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flank/path.h"
#include "flank/radial_function.h"
#include "flank/wheel/point/channel.h"

namespace flank::internal {

/// A pass, place by place along the channel; absent where it must not run or need not.
using PoseRow = std::vector<std::optional<Pose>>;

/// The strip; in two where it turns too sharply, until no piece does. Pieces that are not worth a link are left out.
void add_strip(Strip strip, const RadialFunction& radial, const PointOptions& options, std::vector<Strip>& out);

/// Stretches of poses that are there, as strips; each other row the other way round.
void add_strips(std::vector<PoseRow> rows, const RadialFunction& radial, const PointOptions& options,
                const std::string& kind, const std::string& face, std::vector<Strip>& out);

}  // namespace flank::internal
