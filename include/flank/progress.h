/// Progress and cancellation of long calculations.
#pragma once

#include <exception>
#include <functional>
#include <memory>
#include <string_view>

namespace flank {

/// The best of what a calculation has found so far, by the planner's estimate.
struct BestSoFar {
  double coverage = 0.0;    ///< share of the target's area within the tolerance, in [0, 1]
  double deepest_mm = 0.0;  ///< that anything is cut or entered
  bool clean = false;       ///< nothing is cut or entered by more than the tolerance
};

/// Called from the calling thread between steps. Any member may be empty.
struct Progress {
  /// The stage that runs, and the finished share of the whole calculation in [0, 1].
  std::function<void(std::string_view stage, double share)> report;
  /// True ends the calculation early; the result says that it is incomplete. Once true it stays true.
  std::function<bool()> cancelled;
  class Journal;
  /// Steps that a run that was stopped had finished (read_journal of run.h): they are not done again. None: all are done.
  std::shared_ptr<Journal> journal = nullptr;
  /// What was found on the way; not always better than what was found before.
  std::function<void(const BestSoFar&)> found = nullptr;

  void step(std::string_view stage, double share) const {
    if (report) report(stage, share);
  }
  /// For a part of the whole: its shares 0 to 1 are `low` to `high` of it.
  [[nodiscard]] Progress part(double low, double high) const {
    Progress part = *this;
    if (report)
      part.report = [whole = report, low, high](std::string_view stage, double share) {
        whole(stage, low + (high - low) * share);
      };
    return part;
  }
  [[nodiscard]] bool stop() const { return cancelled && cancelled(); }
};

/// Ends the work of this process early: long loops look between their steps, and end with the best they have. May be called from a
/// signal handler.
void request_stop() noexcept;

/// Thrown, once that was asked, by work whose unfinished result is worth nothing, such as a verdict.
class Stopped : public std::exception {
 public:
  [[nodiscard]] const char* what() const noexcept override { return "stopped"; }
};

}  // namespace flank
