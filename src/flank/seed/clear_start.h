/// Starts beside walls: the tip on the spine of the ball that rolls along target and hub (MATH section 7).
#pragma once

#include <optional>
#include <vector>

#include "flank/obstacle/flank_checks.h"
#include "flank/seed/ruled_start.h"

namespace flank::internal {

/// A start of which every axis line was cut where its ball would enter a check face.
struct ClearStart {
  struct Line {
    ContactLine axis;              ///< fitted to the free stretch of its contact line
    double low = 0.0, high = 0.0;  ///< of the free stretch, mm from the line's middle along its direction
    bool low_blocked = false, high_blocked = false;  ///< a wall ends the stretch
    bool free = false;                               ///< false: no stretch is free; taken from its neighbours
  };
  std::vector<Line> lines;  ///< at kStartTimes times
  double longest_mm = 0.0;  ///< free stretch
  int free_lines = 0;
  int blocked_lines = 0;  ///< lines with a wall at an end
};

[[nodiscard]] ClearStart clear_start(const Chart& chart, const RuledStart& start, const FlankChecks& checks);

/// The motion with its tip at the blocked end of each line (walls at most lines' low end: as directed, else reversed)
/// and the rest of the axis past the other end; lines without a wall are centred.
[[nodiscard]] RuledMotion make_motion(const ClearStart& start, double axis_length, int count);

}  // namespace flank::internal
