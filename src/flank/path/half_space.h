/// Half spaces: what a blank is made of.
#pragma once

#include "flank/vec.h"

namespace flank::internal {

/// The points with <normal, x> <= offset; normal a unit vector, offset in mm.
struct HalfSpace {
  Vec3 normal = Vec3::UnitZ();
  double offset = 0.0;
  [[nodiscard]] bool holds(const Vec3& x) const { return normal.dot(x) <= offset; }
};

}  // namespace flank::internal
