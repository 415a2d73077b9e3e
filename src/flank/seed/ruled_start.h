/// Candidate ruled motions across a target for the automatic start (MATH section 7).
#pragma once

#include "flank/ruled_motion.h"
#include "flank/seed/chart.h"

namespace flank::internal {

/// One candidate: contact lines a = t + skew (b - 1/2), b in a band of [0, 1], offset by `radius` along the normals;
/// the axis is the line fitted to the offset contact line.
struct RuledStart {
  bool swapped = false;    ///< axis along the chart's a direction, motion along b
  double skew_rad = 0.0;   ///< angle of the contact lines against the chart's lines, in the surface; |skew| < pi/2
  double radius_mm = 0.0;  ///< of the tool, mm, at its tip; 0: the contact lines themselves
  /// Of the axis, away from the surface, in [0, pi/2): the tool is a cone that widens from its tip. 0: a cylinder.
  double lean_rad = 0.0;
  bool tip_high = false;                   ///< of a leaning start: the tip is at the high end of the band
  double band_low = 0.0, band_high = 1.0;  ///< share of the width that this strip covers
  double first = 0.0, last = 1.0;          ///< share of the way that the motion goes
};

/// Of the tool of a start, mm, at a distance along the axis from the tip (MATH section 1: r' is the sine of a cone's half angle).
[[nodiscard]] double radius_at(const RuledStart& start, double from_tip_mm);

/// An axis position, by the middle of what it is to touch. (AxisLine of axis_line.h is a line as a user gives it.)
struct FittedLine {
  Vec3 middle, direction;  ///< mm; unit vector, from tip to holder
  double length = 0.0;     ///< mm, of the offset contact line
};

/// The line fitted to the offset contact line of time t (least squares), directed along increasing b.
[[nodiscard]] FittedLine axis_line(const Chart& chart, const RuledStart& start, double t);
inline constexpr int kStartTimes = 41;  ///< of which a start is made

/// The longest offset contact line of a start, mm: the axis length to use if none is given (times 1.02).
[[nodiscard]] double longest_chord(const Chart& chart, const RuledStart& start);

/// The motion of the start with `count` control points per rail; the axis has the given length and is centred on the
/// contact line, or, if it leans, begins at its thin end.
[[nodiscard]] RuledMotion make_motion(const Chart& chart, const RuledStart& start, double axis_length, int count);

}  // namespace flank::internal
