/// Covers among the values of a finished step (base/step_codec.h).
#pragma once

#include "flank/base/step_codec.h"
#include "flank/cover.h"

namespace flank::internal {

void code(StepCodec& codec, CoverResult& cover);
/// Of what distinguishes one cover of a job from another. For fingerprints alone: nothing reads them.
void code(StepCodec& codec, CoverOptions& options);

}  // namespace flank::internal
