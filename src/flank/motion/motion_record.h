/// Motions among the values of a finished step (base/step_codec.h).
#pragma once

#include "flank/base/step_codec.h"
#include "flank/ruled_motion.h"

namespace flank::internal {

/// Rails that are polynomial and clamped over [0, 1], all numbers finite; or the empty motion.
void code(StepCodec& codec, RuledMotion& motion);

}  // namespace flank::internal
