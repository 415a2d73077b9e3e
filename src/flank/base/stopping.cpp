#include "flank/base/stopping.h"

#include <atomic>
#include <chrono>
#include <cstdint>

namespace flank::internal {
namespace {

std::atomic<bool> asked{false};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler sets it");

/// Until when the stop is put off, ns of the steady clock; 0: it is not.
std::atomic<std::int64_t> put_off_until{0};

std::int64_t now_ns() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

}  // namespace

bool stopping() noexcept {
  if (!asked.load(std::memory_order_relaxed)) return false;
  const std::int64_t until = put_off_until.load(std::memory_order_relaxed);
  return until == 0 || now_ns() >= until;
}

void stop_here() {
  if (stopping()) throw Stopped();
}

StopGrace::StopGrace(double seconds) { put_off_until.store(now_ns() + static_cast<std::int64_t>(1e9 * seconds)); }

StopGrace::~StopGrace() { put_off_until.store(0); }

StopForTest::StopForTest() { request_stop(); }

StopForTest::~StopForTest() { asked.store(false, std::memory_order_relaxed); }

}  // namespace flank::internal

namespace flank {

void request_stop() noexcept { internal::asked.store(true, std::memory_order_relaxed); }

}  // namespace flank
