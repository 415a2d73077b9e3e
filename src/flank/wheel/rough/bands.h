/// Roughing in bands: some layers of all channels, before the next ones.
#pragma once

#include <vector>

#include "flank/path.h"

namespace flank::internal {

/// Layers of all channels, from layer 1 down, the strips of a band in the order of `path`: each band ends so many layers below the lowest one of the
/// band before it that has strips, at most; the first one below 0.
[[nodiscard]] std::vector<Path> bands_of(const Path& path, int layers);

}  // namespace flank::internal
