/// How many threads the library works with.
#pragma once

namespace flank {

/// Sets the number of threads that parallel loops use in this process (>= 0); 0 means all cores. Call it once, at
/// start-up, while nothing else of the library runs. No result depends on it.
void set_thread_count(int threads);
/// The number in force, at least 1.
[[nodiscard]] int thread_count();

}  // namespace flank
