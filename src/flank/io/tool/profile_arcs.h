/// The profile of a tool as arcs and lines: what a grinding machine's control follows without a polygon's corners.
#pragma once

#include <vector>

#include "flank/radial_function.h"

namespace flank::internal {

/// An arc of a circle, or a line: ends in mm (x along the axis, y the radius), and the bulge as DXF has it, the tangent of
/// a quarter of the angle that it turns by, positive to the left; 0: a line.
struct ProfileArc {
  Vec2 from, to;
  double bulge = 0.0;
};

/// The meridian as arcs that go on into one another without a corner (biarcs, two for each stretch), from the tip to the
/// holder, no farther than `tolerance_mm` (> 0) from it. Stretches are as long as that allows; they meet on the meridian.
[[nodiscard]] std::vector<ProfileArc> profile_arcs(const RadialFunction& radial, double tolerance_mm);

/// How far a point beside an arc is from it, mm.
[[nodiscard]] double distance_to(const ProfileArc& arc, const Vec2& point);

/// Points of the arc without its end, equally spaced, no chord farther than `chord_mm` from it: at least its beginning.
[[nodiscard]] std::vector<Vec2> points_of(const ProfileArc& arc, double chord_mm);

}  // namespace flank::internal
