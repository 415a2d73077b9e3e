/// How far a surface and what is around it close the space before it and behind it.
#pragma once

#include "flank/triangle_mesh.h"

namespace flank::internal {

/// Shares, 0 to 1, of the rays that leave a surface on one side and meet a triangle: 1 where the space on that side is closed. Rays
/// are spread as light is from a matt wall, so that 1 minus the share is about the area of the openings over that of the walls.
struct Enclosure {
  double before = 0.0;  ///< where the triangles' normals point (counter-clockwise)
  double behind = 0.0;
};

/// Of `surface`, which must have an area, among `all`, itself included: it may close a space alone. The same bits for any number
/// of threads.
[[nodiscard]] Enclosure enclosure(const TriangleMesh& surface, const TriangleMesh& all);

}  // namespace flank::internal
