/// How motions are written as poses of a path, for those who write it and those who ask in advance what it will be.
#pragma once

#include <numbers>

#include "flank/base/tolerance_budget.h"
#include "flank/ruled_motion.h"

namespace flank::internal {

/// Radians, between poses, of the path of any point of the axis: a control that joins them straight leaves corners of up to twice
/// this, below 10 degrees.
inline constexpr double kLargestTurn = 4.5 * std::numbers::pi / 180.0;

/// For a part of this tolerance, mm.
[[nodiscard]] inline SamplingOptions written_path(double tolerance_mm) {
  SamplingOptions options;
  options.chord_tolerance_mm = kToleranceBudget.chord * tolerance_mm;
  options.largest_turn_rad = kLargestTurn;
  return options;
}

}  // namespace flank::internal
