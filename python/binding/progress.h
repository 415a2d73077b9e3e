/// The library's progress as calls of Python, and signals of Python as a reason to stop.
#pragma once

#include <pybind11/pybind11.h>

#include <chrono>

#include "flank/progress.h"

namespace flank::python {

/// One for each calculation that runs without the interpreter's lock. It takes the lock for each call of the callback, and
/// at most every kEvery to look for Ctrl-C.
class PythonProgress {
 public:
  static constexpr std::chrono::milliseconds kEvery{20};

  /// callback(stage, share), or None.
  explicit PythonProgress(pybind11::object callback) : callback_(std::move(callback)) {}

  /// For the library; it must not outlive this.
  [[nodiscard]] Progress progress();
  /// What ended the calculation early: the exception of a signal (KeyboardInterrupt) or of the callback; else None.
  [[nodiscard]] pybind11::object reason() const { return reason_; }

 private:
  void keep_error();
  bool stopped();

  // All of them are touched with the lock held.
  pybind11::object callback_;
  pybind11::object reason_ = pybind11::none();
  std::chrono::steady_clock::time_point looked_{};
};

}  // namespace flank::python
