/// A surface in the place of a face's own.
#pragma once

#include <functional>
#include <optional>

#include "flank/bspline_surface.h"
#include "flank/vec.h"

namespace flank::internal {

/// What takes the place of a face's surface. The borders move to where the new surface meets the neighbours, which are trimmed to it. Where
/// a neighbour ends there or goes on smoothly, they stay, and run along their nearest points on the new surface.
struct NewSurface {
  int face = 0;            ///< 0-based, in the order of the file
  BSplineSurface surface;  ///< mm; reaches past all borders of the face
  /// Parameters of the nearest point of the surface; none: the point lies beyond it.
  std::function<std::optional<Vec2>(const Vec3&)> nearest;
};

}  // namespace flank::internal
