/// What the joints of a machine do over a program, for the page of the report.
#pragma once

#include <string>

#include "flank/machine/post.h"
#include "flank/run.h"

namespace flank::internal {

/// motion.json (docs/schema/motion.md): joints in mm and degrees, the feed of the contact and the largest share of a speed
/// limit at equal times, at most 10,000 of them; null where a joint has no limit. With the
/// program's own verdict.
[[nodiscard]] std::string motion_json(const Machine& machine, const Post& post, const Box3& part,
                                      const WorkSetup& setup, const Acceptance& acceptance);

}  // namespace flank::internal
