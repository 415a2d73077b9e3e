/// Least-squares B-spline surface through scattered points with known parameters.
#pragma once

#include <span>

#include "flank/bspline_surface.h"

namespace flank::internal {

struct ScatteredSplineOptions {
  int degree = 3;
  int count_u = 12, count_v = 12;  ///< control points, at least degree + 1
  /// Weight of the squared second differences of the control points, as a share of the mean diagonal entry of the
  /// normal equations. It decides where no data do, and is too small to show elsewhere.
  double smoothing = 1e-7;
};

/// The polynomial surface over [0, 1]^2 with uniform knots that minimises sum |S(u_i, v_i) - x_i|^2 plus the smoothing.
/// `points` and `parameters` have equal sizes; parameters are clamped to the square.
[[nodiscard]] BSplineSurface fit_scattered(std::span<const Vec3> points, std::span<const Vec2> parameters,
                                           const ScatteredSplineOptions& options);

}  // namespace flank::internal
