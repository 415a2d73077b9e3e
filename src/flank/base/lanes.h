/// Loops over plain arrays that a compiler turns into operations on several numbers at once.
#pragma once

/// Before such a function: compiled twice, and the processor that runs it says which one is called. The results are the same
/// bits, since lanes do not depend on each other and multiplications are not fused with additions (decision 0002).
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__gnu_linux__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define FLANK_LANES __attribute__((target_clones("avx2", "default")))
#else
#define FLANK_LANES
#endif
