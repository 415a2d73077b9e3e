/// How sharply a motion turns.
#pragma once

#include <functional>
#include <span>

#include "flank/path.h"

namespace flank::internal {

/// Of a target's diagonal: turns are looked for within stretches as long as this share of it.
inline constexpr double kTurnStretch = 0.01;

/// Of sharpest_turn().
struct Turning {
  double angle_rad = 0.0;
  std::size_t strip = 0, pose = 0;  ///< 0-based: before which it ends
  std::size_t from_pose = 0;        ///< after which it begins
};

/// The largest angle between two directions of a motion that are at most `window_mm` (> 0) of its way apart, each strip for itself. The
/// motion is one curve of six numbers, tip and upper end of the axis (length `axis_length`, mm), so that a pivot about one end is no
/// turn. Where no point of the axis turns by as much, the largest turn of these points counts: an axis that begins to turn while each of its
/// points goes straight on, from a plane wall to the cone that touches it, has no kink. Directions are those of chords a 32nd of the window long, so that poses that are set closely at a corner do not hide it, poses
/// that are far apart do not, either, and the rounding of a program is no turn. Two ends move: for a length L on the part take sqrt(2) L.
/// Links leave no mark where they turn, and are left out.
[[nodiscard]] Turning sharpest_turn(std::span<const Pose> poses, double axis_length, double window_mm);
/// `window_mm`: of each strip.
[[nodiscard]] Turning sharpest_turn(const Path& path, double axis_length,
                                    const std::function<double(const Strip&)>& window_mm);

/// The window of a target of this diagonal, mm.
[[nodiscard]] double turn_window(double diagonal_mm);

}  // namespace flank::internal
