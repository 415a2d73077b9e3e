/// Strips among the values of a finished step (base/step_codec.h).
#pragma once

#include <vector>

#include "flank/base/step_codec.h"
#include "flank/strip/strip_measure.h"

namespace flank::internal {

void code(StepCodec& codec, CoverStrip& strip);
void code(StepCodec& codec, SweptContact& contact);

/// Throws InputError if a strip names a cell that these samples have not: strips that were read are measured with them.
void require_cells(const std::vector<CoverStrip>& strips, const CoverSamples& samples);

}  // namespace flank::internal
