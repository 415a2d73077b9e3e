/// Smooth extrapolation of a B-spline surface past its borders.
#pragma once

#include "flank/bspline_surface.h"

namespace flank::internal {

/// How far to extend, in units of the surface's own parameters; 0: not at all on that side.
struct ParameterMargins {
  double u_low = 0.0, u_high = 0.0, v_low = 0.0, v_high = 0.0;
};

/// The surface with one more Bezier cell on each extended side. A cell is the polynomial of degree min(2, degree) that
/// passes through the border and fits the outer `fit_share` of each iso-line in the least-squares sense: it joins C0
/// and does not follow ripples at the border, which continuing the last cell would. Rational surfaces are extended in
/// homogeneous coordinates; a side whose extension would reach a weight below a tenth of the border's is left as it is.
/// u first, then v of the result, so the corners come out.
[[nodiscard]] BSplineSurface extend(const BSplineSurface& surface, const ParameterMargins& margins, double fit_share);

}  // namespace flank::internal
