/// Progress and cancellation of long calculations.
#pragma once

#include <functional>
#include <string_view>

namespace flank {

/// Called from the calling thread between steps. Any member may be empty.
struct Progress {
  std::function<void(std::string_view stage, double share)> report;
  std::function<bool()> cancelled;

  void step(std::string_view stage, double share) const {
    if (report) report(stage, share);
  }
  [[nodiscard]] bool stop() const { return cancelled && cancelled(); }
};

}  // namespace flank
