/// Can any pose finish a point of a face? A ball must touch there that enters no face.
#pragma once

#include <vector>

#include "flank/target.h"

namespace flank::internal {

/// False: proved, up to footpoints and rounding, that no tool whose smallest radius is radius_mm touches `point` within the tolerance without cutting one of
/// `faces` deeper than the tolerance. Every such tool holds a ball of that radius that does. `boxes`: directions that are looked at; where they do
/// not suffice for a proof the answer is true.
[[nodiscard]] bool may_be_finished(const Vec3& point, const Vec3& normal, const std::vector<const Target*>& faces,
                                   double radius_mm, double tolerance_mm, int boxes = 2000);

}  // namespace flank::internal
