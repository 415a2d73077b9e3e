/// What came out of a sweep, task by task.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "flank/sweep/plan.h"

namespace flank::internal {

enum class TaskStatus {
  kNotRun,      ///< the sweep was stopped before
  kMeets,       ///< its result meets the request
  kFallsShort,  ///< there is a result, but it does not
  kRefused,     ///< wrong usage or refused input, found while it ran
  kFailed,      ///< it ended by a fault, in every attempt
  kTimedOut,    ///< it took too long, in the last attempt
};
[[nodiscard]] std::string_view status_name(TaskStatus status);

/// What came out of a task. The figures are those of its summary.json; none where there is no result.
struct SweepRow {
  TaskStatus status = TaskStatus::kNotRun;
  int exit_code = -1;
  std::string message;  ///< of a task without a result
  bool kept = false;    ///< from an earlier run; not written anywhere
  bool page = false;    ///< it has a report.html
  struct Figures {
    double coverage = 0.0, coverage_reachable = 0.0;
    double overcut_mm = 0.0, undercut_mm = 0.0, other_faces_overcut_mm = 0.0;
    int strips = 0;
    double slenderness = 0.0;
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
