/// A cylinder or a cone against a straight line of a wall.
#pragma once

#include <optional>

#include "flank/path.h"
#include "flank/radial_function.h"
#include "flank/tour/wall.h"

namespace flank::internal {

/// A flank whose meridian is straight: r(s) = radius + slope s, mm.
struct StraightFlank {
  double radius = 0.0, slope = 0.0;
  [[nodiscard]] double at(double s) const { return radius + slope * s; }
  /// Of a line of this length, mm: how much of the axis lies over it.
  [[nodiscard]] double axis_over(double line_mm) const;
};

/// None for a tool whose meridian bends.
[[nodiscard]] std::optional<StraightFlank> straight_flank(const RadialFunction& tool);

/// The pose in which the flank touches the line from end to end, with s = foot_s over its foot. Exact where the normals at both ends
/// are one; else the flank touches at both ends, and the twist between them is left.
[[nodiscard]] Pose laid_against(const WallLine& line, const StraightFlank& flank, double foot_s);

}  // namespace flank::internal
