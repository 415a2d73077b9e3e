#include "flank/sweep/sweep_result.h"

#include <algorithm>

namespace flank::internal {

std::string_view status_name(TaskStatus status) {
  switch (status) {
    case TaskStatus::kNotRun:
      return "not run";
    case TaskStatus::kMeets:
      return "meets the request";
    case TaskStatus::kFallsShort:
      return "falls short";
    case TaskStatus::kRefused:
      return "refused";
    case TaskStatus::kFailed:
      return "failed";
    case TaskStatus::kTimedOut:
      return "timed out";
  }
  return "";
}

int SweepResult::count(TaskStatus status) const {
  return static_cast<int>(
      std::count_if(rows.begin(), rows.end(), [&](const SweepRow& row) { return row.status == status; }));
}

}  // namespace flank::internal
