/// Faces through the points of a formula.
#pragma once

#include <functional>

#include "flank/face.h"

namespace flank::internal {

/// A face of degree 3, called F1, through count_u x count_v (>= 4 each) points of a formula over the unit square, at equal
/// steps.
[[nodiscard]] Face interpolated(const std::function<Vec3(double u, double v)>& formula, int count_u, int count_v);

}  // namespace flank::internal
