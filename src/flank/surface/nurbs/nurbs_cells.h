/// Nearly flat cells of a face: the leaves of the search for a closest point.
#pragma once

#include <array>
#include <vector>

#include "flank/surface/nurbs/nurbs_face.h"

namespace flank::internal {

/// A part of one knot cell, small enough that a descent within it finds its closest point.
struct FlatCell {
  int face = 0;
  ParameterBox reach;  ///< what a descent from this cell may use: a little more than the cell, within its zone and the
                       ///< face's domain
  ParameterBox zone;   ///< the zone within the domain
  Vec3 normal = Vec3::Zero();  ///< S_u x S_v of the centre, unit
  /// Range of the larger principal curvature towards +normal and towards -normal, a little widened.
  std::array<double, 2> curvature_low{}, curvature_high{};
  double line_curvature = 0.0;  ///< at least the largest geodesic curvature of the parameter lines, and so of its sides
  bool cut = false;             ///< a trim passes through it
  double u0 = 0.0, u1 = 0.0, v0 = 0.0, v1 = 0.0;
  Vec3 center = Vec3::Zero();
  Vec3 to_u = Vec3::Zero(), to_v = Vec3::Zero();  ///< u = mid + <p - center, to_u> on the tangent plane at the centre
};

/// Whether a point at `r` from the centre can have several closest points in the cell: where the sphere about it can
/// osculate the surface.
[[nodiscard]] bool can_be_focal(const FlatCell& cell, const Vec3& r);

/// Whether a point at `r` from the centre has one closest point in the cell at most: it is nearer than the centres of curvature of the
/// surface and of the cell's sides, so that the squared distance is convex.
[[nodiscard]] bool is_convex(const FlatCell& cell, const Vec3& r);

/// Cells that cover the trimmed face, with their Bezier hulls.
struct FlatCells {
  std::vector<FlatCell> cells;
  std::vector<std::vector<Vec3>> hulls;
};
void append_flat_cells(const NurbsFace& face, int index, FlatCells& out);

}  // namespace flank::internal
