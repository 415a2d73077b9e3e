/// Roughing in bands: some layers of all channels, before the next ones.
#pragma once

#include <vector>

#include "flank/path.h"

namespace flank::internal {

/// So many layers of all channels each, from the tips down, the strips of a band in the order of `path`; a band without strips is left out. In `path`
/// layer 1 is the one on the floor; in what comes out it is the highest one of all.
[[nodiscard]] std::vector<Path> bands_of(const Path& path, int layers);

}  // namespace flank::internal
