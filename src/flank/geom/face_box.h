/// Where a face is, without asking its surface.
#pragma once

#include "flank/face.h"
#include "flank/vec.h"

namespace flank::internal {

/// A box that holds the face: that of the control points of the smallest patch of its surface, along its parameters, that the trims lie in. A small face
/// may be cut out of a large surface.
[[nodiscard]] Box3 box_of(const Face& face);

/// Whether two boxes come nearer to each other than `within_mm` in all three directions.
[[nodiscard]] bool near(const Box3& a, const Box3& b, double within_mm = 0.0);

}  // namespace flank::internal
