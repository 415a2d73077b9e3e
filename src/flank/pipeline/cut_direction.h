/// Climb or conventional milling: in which direction the motions of a path are run.
#pragma once

#include <string>
#include <vector>

#include "flank/ruled_motion.h"
#include "flank/setup/targets.h"

namespace flank::internal {

/// How much a motion climbs, from -1 (conventional all along) to 1 (climb all along): the tool's edge, whose spindle turns clockwise seen
/// from the holder, runs against the feed where it touches the target. The mean over its way at the middle of the axis.
[[nodiscard]] double climb_share(const RuledMotion& motion, const Target& target);

/// Turns the motions round that do not mill as `cut` ("climb" or "conventional") says. Where all of them are turned, their order is
/// turned, too: what was joined stays joined. groups[k] is what motion k machines, and follows.
void run_as(const std::string& cut, std::vector<RuledMotion>& motions, std::vector<const TargetGroup*>& groups);

}  // namespace flank::internal
