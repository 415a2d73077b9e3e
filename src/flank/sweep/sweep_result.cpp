#include "flank/sweep/sweep_result.h"

#include <algorithm>

namespace flank::internal {

int SweepResult::count(TaskStatus status) const {
  return static_cast<int>(
      std::count_if(rows.begin(), rows.end(), [&](const SweepRow& row) { return row.status == status; }));
}

}  // namespace flank::internal
