/// Parallel loops whose result does not depend on the number of threads, nor on how many numbers a processor takes at once.
#pragma once

#include <cstddef>
#include <functional>

/// Before a function of loops over plain arrays, which a compiler turns into operations on several numbers at once: it is compiled
/// twice, and the processor that runs it says which one is called. The results are the same bits, since lanes do not depend on
/// each other and multiplications are not fused with additions (decision 0002).
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__gnu_linux__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define FLANK_LANES __attribute__((target_clones("avx2", "default")))
#else
#define FLANK_LANES
#endif

namespace flank::internal {

/// Calls body(i) for every i in [0, count), in any order and from any thread. Each call writes only to what belongs to
/// i, so the outcome is the same for any number of threads. The first exception thrown is rethrown here.
void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body);

/// The same over blocks [begin, end) of at most `grain` indices, for cheap bodies with scratch memory per block.
void parallel_blocks(std::size_t count, std::size_t grain,
                     const std::function<void(std::size_t begin, std::size_t end)>& body);

}  // namespace flank::internal
