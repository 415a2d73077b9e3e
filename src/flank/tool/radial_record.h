/// Radial functions and tools among the values of a finished step (base/step_codec.h).
#pragma once

#include "flank/base/step_codec.h"
#include "flank/radial_function.h"
#include "flank/tool.h"

namespace flank::internal {

/// Finite parameters in the number that the family has, and a length above zero; or the empty function.
void code(StepCodec& codec, RadialFunction& radial);
/// For fingerprints alone: nothing reads it.
void code(StepCodec& codec, Tool& tool);

}  // namespace flank::internal
