/// Where the axis begins on both sides of a cavity, before anything is fitted.
#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "flank/fit.h"
#include "flank/seed/clear_start.h"

namespace flank::internal {

/// Not owned; they outlive the fit. Obstacles may be null: nothing is in the way.
struct CavitySide {
  const Target* target = nullptr;
  const ObstacleField* obstacles = nullptr;
};

/// One way to lay the axis: along the lines of the left side's chart (or across them), turned by a skew.
struct SideStart {
  bool swapped = false;
  double skew_rad = 0.0;
  double radius_mm = 1.0;
  /// Radius of the tip: below the other one the tool is a cone that widens to that.
  double tip_mm = std::numeric_limits<double>::infinity();
};

/// Starts of all layers, two motions each (left, right), the top layer first. The right side's lines are those of its
/// chart that are most nearly parallel to the left one's. Tips are at the walls, else away from `up`, else where the cavity
/// is narrower. Empty: no line is free.
[[nodiscard]] std::vector<FitTask> side_tasks(const CavitySide& left, const CavitySide& right, const Chart& left_chart,
                                              const Chart& right_chart, const SideStart& start, int layers,
                                              const std::function<double(double)>& axis_length,
                                              const std::optional<Vec3>& up);

}  // namespace flank::internal
