/// Samples of a NURBS face.
#pragma once

#include <vector>

#include "flank/surface/nurbs/nurbs_face.h"

namespace flank::internal {

/// Appends the middles of the cells of a grid in (u, v) whose lines are `spacing_mm` apart on average, u index major.
void append_samples(const NurbsFace& face, int index, double spacing_mm, std::vector<SurfaceSample>& out);

/// Area of the part of a parameter rectangle within the trims: rectangles that a trim cuts are quartered `depth` times.
[[nodiscard]] double trimmed_area(const NurbsFace& face, const ParameterRectangle& r, int depth);

}  // namespace flank::internal
