/// Bounds of a rail and of its derivatives over an interval: by the convex hull of Bezier points, not by sampling.
#pragma once

#include "flank/bspline_curve.h"
#include "flank/vec.h"

namespace flank::internal {

/// Derivative of a polynomial B-spline curve as a curve of one degree less (Piegl and Tiller, eq. 3.8). Degree >= 1.
[[nodiscard]] BSplineCurve3 derivative(const BSplineCurve3& curve);

/// Upper bound of |curve(t)| over [t0, t1]; exact where the curve is linear there. Polynomial curves only.
[[nodiscard]] double largest_norm(const BSplineCurve3& curve, double t0, double t1);

/// Lower bound of <curve(t), direction> over [t0, t1]. Polynomial curves only.
[[nodiscard]] double smallest_component(const BSplineCurve3& curve, const Vec3& direction, double t0, double t1);

}  // namespace flank::internal
