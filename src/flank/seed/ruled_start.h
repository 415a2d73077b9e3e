/// Candidate ruled motions across a target for the automatic start.
#pragma once

#include "flank/ruled_motion.h"
#include "flank/seed/chart.h"

namespace flank::internal {

/// One candidate: contact lines a = t + skew (b - 1/2), b in a band of [0, 1], offset by `radius` along the normals;
/// the axis is the line fitted to the offset contact line.
struct RuledStart {
  bool swapped = false;   ///< axis along the chart's a direction, motion along b
  double skew_rad = 0.0;  ///< angle of the contact lines against the chart's lines, in the surface
  double radius_mm = 1.0;
  double band_low = 0.0, band_high = 1.0;  ///< share of the width that this strip covers
  double overrun = 0.03;                   ///< of the axis past both ends of the contact line
};

/// A line of the axis through the middle of what it is to touch.
struct ContactLine {
  Vec3 middle, direction;
  double length = 0.0;
};

/// The line fitted to the offset contact line of time t (least squares), directed along increasing b.
[[nodiscard]] ContactLine axis_line(const Chart& chart, const RuledStart& start, double t);
inline constexpr int kStartTimes = 41;  ///< of which a start is made

/// The longest offset contact line of a start, mm: the axis length to use where none is given (times 1.02).
[[nodiscard]] double longest_chord(const Chart& chart, const RuledStart& start);

/// The motion of the start with `count` control points a rail; the axis has the given length and is centred on the
/// contact line.
[[nodiscard]] RuledMotion make_motion(const Chart& chart, const RuledStart& start, double axis_length, int count);

}  // namespace flank::internal
