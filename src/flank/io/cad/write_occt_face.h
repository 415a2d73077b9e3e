/// A face value as an Open CASCADE face. Private to io: no Open CASCADE type leaves this folder.
#pragma once

#include <Geom_BSplineSurface.hxx>
#include <TopoDS_Face.hxx>

#include "flank/face.h"

namespace flank::internal {

/// The trimmed face, oriented as `reversed` says. Throws InternalError where a trim has no curve in space.
[[nodiscard]] TopoDS_Face occt_face(const Face& face);

/// The surface with all its poles, knots and weights.
[[nodiscard]] Handle(Geom_BSplineSurface) occt_surface(const BSplineSurface& surface);

/// Area that a loop encloses in the parameter plane, positive counter-clockwise; of a polyline through its edges.
[[nodiscard]] double signed_area(const TrimLoop& loop);

}  // namespace flank::internal
