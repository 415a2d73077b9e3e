/// The result of motions that are aimed at the mirrored face.
#pragma once

#include "flank/correct/motion/aimed_motion.h"
#include "flank/run.h"

namespace flank::internal {

/// Path, verdict and drawings of these motions. `job`: on the part with the mirrored face, one target. Throws Stopped, InputError.
[[nodiscard]] Result aimed_result(const PlanJob& job, const Tool& tool, AimedMotions aimed);

}  // namespace flank::internal
