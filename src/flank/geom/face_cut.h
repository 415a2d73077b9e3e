/// Cutting pieces out of faces along parameter lines.
#pragma once

#include <vector>

#include "flank/face.h"

namespace flank::internal {

/// The part of a surface between two parameters of u (along_u) or v, exactly: same points at the same parameters. `b` may
/// lie past the end of a surface that is closed in that direction, by less than a turn: the piece then goes across the
/// seam.
[[nodiscard]] BSplineSurface cut_surface(const BSplineSurface& surface, bool along_u, double a, double b);

/// What the loops (even-odd rule) enclose of the parameters >= `at` (or <= at): the same curves where they are inside,
/// joined by straight edges along the line. A loop that runs along the line is taken as inside. Empty where nothing is
/// left.
[[nodiscard]] std::vector<TrimLoop> cut_loops(const std::vector<TrimLoop>& loops, bool along_u, double at, bool above);

/// The part of a face between two parameters; surface and trims are cut. A trimmed face cannot be cut across its seam.
/// Throws InputError if nothing is left.
[[nodiscard]] Face cut_face(const Face& face, bool along_u, double a, double b);

/// Whether the first and the last row of control points in a direction are the same, to within rounding: the surface
/// closes upon itself.
[[nodiscard]] bool is_closed(const BSplineSurface& surface, bool along_u);

}  // namespace flank::internal
