/// Ending a program's work early: long loops look here between their steps, and end with the best they have. Handing a
/// Progress down stops a search between its stages; this stops within them.
#pragma once

#include "flank/progress.h"

namespace flank::internal {

/// Whether the process is to end what it does.
[[nodiscard]] bool stopping() noexcept;

/// Throws Stopped if stopping().
void stop_here();

/// As long as it lives, but for no longer than so many seconds, stopping() is false: for what a result needs after the
/// stop, and that ends soon. One at a time.
class StopGrace {
 public:
  explicit StopGrace(double seconds);
  ~StopGrace();
  StopGrace(const StopGrace&) = delete;
  StopGrace& operator=(const StopGrace&) = delete;
};

/// For tests: true as long as it lives.
class StopForTest {
 public:
  StopForTest();
  ~StopForTest();
  StopForTest(const StopForTest&) = delete;
  StopForTest& operator=(const StopForTest&) = delete;
};

}  // namespace flank::internal
