/// Roughing in bands: some layers of all channels, before the next ones.
#pragma once

#include <vector>

#include "flank/path.h"

namespace flank::internal {

/// So many layers of all channels each, from layer 1 down, the strips of a band in the order of `path`; a band without strips is left out.
[[nodiscard]] std::vector<Path> bands_of(const Path& path, int layers);

}  // namespace flank::internal
