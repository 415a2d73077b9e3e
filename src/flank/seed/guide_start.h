/// A start from the lines of a guide (guide_file.h; paper A 4.4): the ends of the lines are the control polygons of two
/// cubic B-spline rails, which are then made rigid (MATH section 2).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flank/ruled_motion.h"
#include "flank/seed/axis_line.h"
#include "flank/target.h"

namespace flank::internal {

struct GuideStart {
  RuledMotion motion;
  double mean_length_mm = 0.0;      ///< of the two rails' distance: the axis length if none is given
  double largest_stretch_mm = 0.0;  ///< how far the holder end was moved to make the axis rigid
};

/// The rigid motion of a guide: its tip rail is the guide's, its axis points to the guide's holder rail. Fewer than
/// four lines give rails of a lower degree. Throws InputError naming the file if the guide has no extent or an axis
/// of it vanishes on the way.
[[nodiscard]] GuideStart start_from_guide(const std::string& file, const std::vector<AxisLine>& lines,
                                          std::optional<double> axis_length_mm, int control_points = 24);

/// +1: the motion runs on the machining side of the target, -1: on the other side.
[[nodiscard]] int side_of_motion(const Target& target, const RuledMotion& motion);

}  // namespace flank::internal
