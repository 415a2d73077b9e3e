/// Rigid motions of a target into itself: screws, gears' teeth, surfaces of revolution and prisms are moved along
/// themselves by one. A line that goes with it keeps its distances, so whatever line is taken, some tool fits exactly.
#pragma once

#include <optional>
#include <span>

#include "flank/target.h"

namespace flank::internal {

/// A uniform motion: a turn about a fixed axis with a slide along it, a turn alone, or a slide alone.
struct SelfMotion {
  Vec3 centre = Vec3::Zero();                       ///< mm; a point of the axis of the turn
  Vec3 turn = Vec3::Zero(), slide = Vec3::UnitZ();  ///< radians and mm in a unit of time; parallel unless turn is zero
  double sine = 0.0;                                ///< root mean square, of the angle between velocity and target

  [[nodiscard]] Vec3 velocity(const Vec3& p) const { return slide + turn.cross(p - centre); }
  /// A true screw at this point: neither its turn nor its slide is small beside the other.
  [[nodiscard]] bool is_screw_at(const Vec3& p) const;
  /// Where a point is after a time, and which way a vector points then.
  [[nodiscard]] Vec3 moved(const Vec3& p, double time) const;
  [[nodiscard]] Vec3 turned(const Vec3& direction, double time) const;
};

/// The uniform motion whose velocities are nearest to tangential at the samples: the smallest eigenvector of the form
/// <n, v>^2 against |v|^2 (Pottmann and Wallner, Computational Line Geometry, 2001, section 4.2). None if it leaves the
/// target by more than a degree or two, or if there are several (planes, spheres, cylinders): then nothing tells
/// which is meant. The mean speed is 1 mm.
[[nodiscard]] std::optional<SelfMotion> self_motion(std::span<const SurfaceSample> samples);

}  // namespace flank::internal
