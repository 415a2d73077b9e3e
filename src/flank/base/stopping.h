/// Ending a program's work early: long loops look here between their steps, and end with the best they have. Handing a
/// Progress down stops a search between its stages; this stops within them.
#pragma once

#include <exception>

namespace flank::internal {

/// From now on stopping() is true, in the whole process. May be called from a signal handler.
void request_stop() noexcept;
/// Whether the process is to end what it does.
[[nodiscard]] bool stopping() noexcept;

/// Thrown by work whose unfinished result is worth nothing, such as a verdict.
class Stopped : public std::exception {
 public:
  [[nodiscard]] const char* what() const noexcept override { return "stopped"; }
};
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
