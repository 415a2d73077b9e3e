/// Parallel loops whose result does not depend on the number of threads.
#pragma once

#include <cstddef>
#include <functional>

namespace flank::internal {

/// Calls body(i) for every i in [0, count), in any order and from any thread. Each call writes only to what belongs to
/// i, so the outcome is the same for any number of threads. The first exception thrown is rethrown here.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body);

/// The same over blocks [begin, end) of at most `grain` indices, for cheap bodies with scratch memory per block.
void parallel_blocks(std::size_t count, std::size_t grain,
                     const std::function<void(std::size_t begin, std::size_t end)>& body);

}  // namespace flank::internal
