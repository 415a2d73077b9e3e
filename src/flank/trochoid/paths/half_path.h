/// Half paths: from a place beside one side of a cavity to a place beside the other, tangential to both side paths.
///
/// Tip and direction are clamped cubic rails of six control points, so the tool is exactly rigid (MATH section 2). The
/// outer two of each end are given by place and velocity there, the inner two by least fairness and length.
#pragma once

#include "flank/ruled_motion.h"

namespace flank::internal {

/// An axis position and its velocity per mm of way of the axis' middle.
struct AxisPlace {
  Vec3 tip, u;
  Vec3 tip_dx, u_dx;
  [[nodiscard]] Vec3 at(double s) const { return tip + s * u; }
  [[nodiscard]] Vec3 velocity(double s) const { return tip_dx + s * u_dx; }
  /// The same place, run through backwards.
  [[nodiscard]] AxisPlace reversed() const { return {tip, u, -tip_dx, -u_dx}; }
};

struct HalfShape {
  double leave_mm = 1.0, arrive_mm = 1.0;  ///< handles: how far the second and the last but one control points are off
  double bulge_mm = 0.0;                   ///< of the inner points, in the direction in which the path leaves
  /// Of the inner points, along the axis; of the outer ones beside them a share, because the inner ones alone hardly
  /// lift what lies near the ends.
  double lift_mm = 0.0;
};

/// From one place to another, leaving and arriving with their velocities.
[[nodiscard]] RuledMotion half_path(double axis_length, const AxisPlace& from, const AxisPlace& to,
                                    const HalfShape& shape);

/// How far a half path goes beyond the line between its ends, in the direction in which it leaves, mm, >= 0.
[[nodiscard]] double reach_ahead(const RuledMotion& half, const AxisPlace& from, const AxisPlace& to);

/// A half path that reaches less far ahead: of what it has at either end a share, 0 to 1. Velocities are turned towards the way
/// across, so with none it goes straight across, and is no longer tangential to the side paths.
[[nodiscard]] RuledMotion half_path_across(double axis_length, const AxisPlace& from, const AxisPlace& to,
                                           const HalfShape& shape, double share_from, double share_to);

/// A half path that leaves and arrives with the velocities of its ends in corners of these radii, mm, and goes straight across between
/// them: no half that reaches so far ahead is less bent, and what a cycle engages in a corner grows with how it is bent.
[[nodiscard]] RuledMotion half_path_round(double axis_length, const AxisPlace& from, const AxisPlace& to,
                                          double lift_mm, double corner_from, double corner_to);

/// The same where the room is behind, before the wall at which a layer begins: turned across as far as it takes. What is cut there has
/// been cut by the entry, so that its corners matter little.
[[nodiscard]] RuledMotion half_off_wall(double axis_length, const AxisPlace& from, const AxisPlace& to,
                                        const HalfShape& shape, double room_from, double room_to);

/// A half path between two places that have so much room ahead before a wall, mm, or infinitely much: with round corners if it
/// would reach farther.
[[nodiscard]] RuledMotion half_before_wall(double axis_length, const AxisPlace& from, const AxisPlace& to,
                                           const HalfShape& shape, double room_from, double room_to);

/// Length of the way of the axis' middle, mm.
[[nodiscard]] double way_of_middle(const RuledMotion& motion);

}  // namespace flank::internal
