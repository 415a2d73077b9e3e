/// Operations that are run several times, turned about an axis of the part: the blades of a wheel, the sides of a polygon.
#pragma once

#include <string>

#include "flank/path.h"
#include "flank/setup/setup.h"

namespace flank::internal {

/// The axis about which copies are turned, in the part's frame.
struct CopyAxis {
  Vec3 point = Vec3::Zero(), direction = Vec3::UnitZ();  ///< mm; a unit vector
};

/// "x,y,z,x,y,z": a point and a direction. Throws UsageError about the field `copy_axis`.
[[nodiscard]] CopyAxis parse_copy_axis(const std::string& text);
[[nodiscard]] std::string copy_axis_text(const CopyAxis& axis);

/// The turn of copy k of n, both counted from 1: (k - 1) / n of a turn, right-handed about the axis. Copy 1 stays.
[[nodiscard]] Eigen::Isometry3d copy_turn(const CopyAxis& axis, int copy, int copies);

[[nodiscard]] Path turned(Path path, const Eigen::Isometry3d& turn);

/// Throws InputError unless the faces that are machined or checked come to lie on themselves when they are turned by 360 degrees / copies
/// (to a tenth of the tolerance, or what their triangles are true to), and for fixtures, which do not turn with the part. Then a path
/// that is turned does to the part what the path itself does.
void require_same_when_turned(const Setup& setup, const CopyAxis& axis, int copies);

}  // namespace flank::internal
