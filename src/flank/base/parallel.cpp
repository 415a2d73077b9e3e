#include "flank/base/parallel.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "flank/base/assert.h"
#include "flank/base/work_count.h"
#include "flank/threads.h"

namespace flank::internal {
namespace {

#ifdef __SANITIZE_THREAD__
// oneTBB comes without instrumentation, so the thread sanitizer cannot see it hand work over and reports every loop.
// Plain threads are seen: with them it judges our loop bodies and nothing else.
template <class Run>
void run_blocks(std::size_t blocks, const Run& run) {
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex failure_mutex;
  auto work = [&] {
    try {
      for (std::size_t block = next++; block < blocks; block = next++) run(block);
    } catch (...) {
      const std::lock_guard lock(failure_mutex);
      if (!failure) failure = std::current_exception();
      next = blocks;
    }
  };
  std::vector<std::thread> threads(std::min(blocks, static_cast<std::size_t>(thread_count())));
  for (std::thread& thread : threads) thread = std::thread(work);
  for (std::thread& thread : threads) thread.join();
  if (failure) std::rethrow_exception(failure);
}
#else
template <class Run>
void run_blocks(std::size_t blocks, const Run& run) {
  tbb::parallel_for(std::size_t{0}, blocks, run);
}
#endif

}  // namespace

void parallel_for(std::size_t count, const std::function<void(std::size_t)>& body) {
  FLANK_ASSERT(body != nullptr);
  parallel_blocks(count, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) body(i);
  });
}

void parallel_blocks(std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body) {
  FLANK_ASSERT(body != nullptr);
  if (count == 0) return;
  const std::size_t step = std::max<std::size_t>(1, grain);
  const std::size_t blocks = (count + step - 1) / step;
  auto run = [&](std::size_t block) { body(block * step, std::min(count, (block + 1) * step)); };
  if (thread_count() == 1 || blocks == 1) {
    for (std::size_t block = 0; block < blocks; ++block) run(block);
    return;
  }
  std::atomic<std::uint64_t> work{0};
  run_blocks(blocks, [&](std::size_t block) {
    const LoopWork counted(work);
    run(block);
  });
  count_work(work);
}

}  // namespace flank::internal
