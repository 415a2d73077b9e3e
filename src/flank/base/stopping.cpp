#include "flank/base/stopping.h"

#include <atomic>

namespace flank::internal {
namespace {

std::atomic<bool> asked{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler sets it");

}  // namespace

void request_stop() noexcept { asked.store(true, std::memory_order_relaxed); }

bool stopping() noexcept { return asked.load(std::memory_order_relaxed); }

void stop_here() {
  if (stopping()) throw Stopped();
}

StopForTest::StopForTest() { request_stop(); }

StopForTest::~StopForTest() { asked.store(false, std::memory_order_relaxed); }

}  // namespace flank::internal
