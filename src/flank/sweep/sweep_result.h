/// What came out of a sweep, task by task.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flank/sweep/plan.h"
#include "flank/sweep/task_batch.h"

namespace flank::internal {

/// What came out of a task. The figures are those of its summary.json; none where there is no result.
struct SweepRow : TaskRow {
  struct Figures {
    double coverage = 0.0, coverage_reachable = 0.0;
    double overcut_mm = 0.0, undercut_mm = 0.0, other_faces_overcut_mm = 0.0;
    int strips = 0;
    double slenderness = 0.0;
    std::vector<std::string> reasons, cautions;  ///< names of the figures that they are about, each once
  };
  std::optional<Figures> figures;
};

struct SweepResult {
  SweepPlan plan;
  std::vector<SweepRow> rows;  ///< row k is that of plan.tasks[k]
  [[nodiscard]] int count(TaskStatus status) const;
  [[nodiscard]] bool complete() const { return count(TaskStatus::kNotRun) == 0; }
  [[nodiscard]] bool pass() const { return count(TaskStatus::kMeets) == static_cast<int>(rows.size()); }
};

}  // namespace flank::internal
