/// Samples that tell finely where the reachable part of a target ends.
#pragma once

#include "flank/judge.h"
#include "flank/pipeline/folder/target_reach.h"
#include "flank/verify/sampler.h"

namespace flank::internal {

/// `samples` of a tile, with their reachable shares, where those at the border of what is reachable (verify/reach_border) give
/// way to those of the parts of their cells: what is covered mostly ends where what is reachable does, and a cell there would be
/// covered as its middle is, or open as a whole.
[[nodiscard]] FaceSamples with_fine_border(const verify::Sampler& sampler, const TargetReach& reach, int face,
                                           const FaceSamples& samples);

}  // namespace flank::internal
