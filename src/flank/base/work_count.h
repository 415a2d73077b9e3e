/// How much a calculation has done, counted and not timed: a search that ends at a number ends at the same place on every machine.
///
/// The unit is one look at one point: a residual with its footpoint, or a sample held against what a motion cuts. A normal processor
/// does about a million of them in a second.
#pragma once

#include <atomic>
#include <cstdint>

#include "flank/progress.h"

namespace flank::internal {

/// Adds to what the calling thread has done. Cheap: once for each list of points.
void count_work(std::uint64_t looks) noexcept;

/// What the calling thread has done, with all that the parallel loops that it called did for it. Only differences mean something.
[[nodiscard]] std::uint64_t work_done() noexcept;

/// The progress of a calculation that is to end as if it were cancelled once the calling thread has done so many looks more.
[[nodiscard]] Progress limited(const Progress& progress, double most_looks);

/// A part of a parallel loop: what is counted while it lives goes to the loop's sum, and not to the thread that happens to run it, which may
/// wait in another loop.
class LoopWork {
 public:
  explicit LoopWork(std::atomic<std::uint64_t>& sum) noexcept : sum_(sum), before_(work_done()) {}
  ~LoopWork();
  LoopWork(const LoopWork&) = delete;
  LoopWork& operator=(const LoopWork&) = delete;

 private:
  std::atomic<std::uint64_t>& sum_;
  std::uint64_t before_;
};

}  // namespace flank::internal
