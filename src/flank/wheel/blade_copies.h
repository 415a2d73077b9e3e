/// Paths of one blade's sides carried over to the other blades: turned, and led onto each where the blades are not quite equal.
#pragma once

#include <vector>

#include "flank/feature/wheel_axis.h"
#include "flank/path.h"
#include "flank/radial_function.h"
#include "flank/target.h"

namespace flank::internal {

/// How far samples of a side, turned, are from another one at most, mm; those beside its border do not count.
[[nodiscard]] double side_difference(const std::vector<const Target*>& side, const std::vector<const Target*>& other,
                                     const WheelAxis& axis, double radians);

/// A strip of one side on another one that differs a little. Each pose is turned, and moved by the least rigid motion that makes its
/// spheres as far from the other side as they were from their own; the same for the tip over the floor. Motions are means over a few
/// poses.
[[nodiscard]] Strip carried_over(const Strip& strip, const RadialFunction& radial,
                                 const std::vector<const Target*>& side, const std::vector<const Target*>& other,
                                 const std::vector<const Target*>& floor, const WheelAxis& axis, double radians);

}  // namespace flank::internal
