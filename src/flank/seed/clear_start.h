/// Starts beside walls: the tip on the spine of the ball that rolls along target and hub (MATH section 7).
#pragma once

#include <optional>
#include <vector>

#include "flank/obstacle_field.h"
#include "flank/seed/ruled_start.h"

namespace flank::internal {

/// A start of which every axis line was cut at the place where its ball would enter a check face.
struct ClearStart {
  /// The line of one time.
  struct Line {
    FittedLine axis;               ///< fitted to the free stretch of its contact line
    double low = 0.0, high = 0.0;  ///< of the free stretch, mm from the line's middle along its direction
    bool low_blocked = false, high_blocked = false;  ///< a wall ends the stretch
    bool free = false;                               ///< false: no stretch is free; taken from its neighbours
  };
  std::vector<Line> lines;         ///< at kStartTimes times
  std::optional<bool> tip_high;    ///< of a start that leans: the tip is at the lines' high end
  double first = 0.0, last = 1.0;  ///< of these times: less where lines at the ends are blocked altogether
  double longest_mm = 0.0;         ///< free stretch
  int free_lines = 0;
  int blocked_lines = 0;  ///< lines with a wall at an end
};

/// Without a free line (free_lines = 0) there is no motion to make. If lines at the ends of the motion are blocked
/// altogether, the times are squeezed into what is free and half a radius of the ball past it.
[[nodiscard]] ClearStart clear_start(const Chart& chart, const RuledStart& start, const ObstacleField& obstacles);

/// The motion with its tip at the blocked end of each line and the rest of the axis past the other end. Unless the start leans, the tip is at
/// the lines' low end if most walls are there, else the lines are reversed. A line without a wall starts a little
/// before its free stretch; if no line has one, all are centred. Needs a start with free lines.
[[nodiscard]] RuledMotion make_motion(const ClearStart& start, double axis_length, int count);

}  // namespace flank::internal
