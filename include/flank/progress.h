/// Progress and cancellation of long calculations.
#pragma once

#include <functional>
#include <memory>
#include <string_view>

namespace flank {

/// Called from the calling thread between steps. Any member may be empty.
struct Progress {
  /// The stage that runs, and the finished share of the whole calculation in [0, 1].
  std::function<void(std::string_view stage, double share)> report;
  /// True ends the calculation early; the result says that it is incomplete. Once true it stays true.
  std::function<bool()> cancelled;
  class Journal;
  /// Steps that a run that was stopped had finished (read_journal of run.h): they are not done again. None: all are done.
  std::shared_ptr<Journal> journal = nullptr;

  void step(std::string_view stage, double share) const {
    if (report) report(stage, share);
  }
  [[nodiscard]] bool stop() const { return cancelled && cancelled(); }
};

}  // namespace flank
