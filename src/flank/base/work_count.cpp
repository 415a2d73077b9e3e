#include "flank/base/work_count.h"

namespace flank::internal {
namespace {

thread_local std::uint64_t done = 0;

}  // namespace

void count_work(std::uint64_t looks) noexcept { done += looks; }

std::uint64_t work_done() noexcept { return done; }

Progress limited(const Progress& progress, double most_looks) {
  Progress own = progress;
  own.cancelled = [progress, first = work_done(), most_looks] {
    return progress.stop() || static_cast<double>(work_done() - first) >= most_looks;
  };
  return own;
}

LoopWork::~LoopWork() {
  sum_.fetch_add(done - before_, std::memory_order_relaxed);
  done = before_;
}

}  // namespace flank::internal
