/// Tensor-product B-spline surfaces, polynomial or rational, non-periodic, clamped.
#pragma once

#include <vector>

#include "flank/bspline_basis.h"
#include "flank/vec.h"

namespace flank {

/// Point and partial derivatives up to second order.
struct SurfaceJet {
  Vec3 p = Vec3::Zero(), du = Vec3::Zero(), dv = Vec3::Zero();
  Vec3 duu = Vec3::Zero(), duv = Vec3::Zero(), dvv = Vec3::Zero();
};

/// A value. Points in mm, parameters without unit; the outward side is given by Face::reversed.
struct BSplineSurface {
  int degree_u = 0, degree_v = 0;
  std::vector<double> knots_u, knots_v;
  int count_u = 0, count_v = 0;
  std::vector<Vec3> poles;      ///< pole (i, j) at i * count_v + j
  std::vector<double> weights;  ///< empty: polynomial

  /// Control point i along u, j along v; not checked.
  [[nodiscard]] const Vec3& pole(int i, int j) const { return poles[static_cast<std::size_t>(i * count_v + j)]; }
  [[nodiscard]] Vec3& pole(int i, int j) { return poles[static_cast<std::size_t>(i * count_v + j)]; }
  /// Ends of the domain.
  [[nodiscard]] double u_first() const { return knots_u[static_cast<std::size_t>(degree_u)]; }
  [[nodiscard]] double u_last() const { return knots_u[static_cast<std::size_t>(count_u)]; }
  [[nodiscard]] double v_first() const { return knots_v[static_cast<std::size_t>(degree_v)]; }
  [[nodiscard]] double v_last() const { return knots_v[static_cast<std::size_t>(count_v)]; }

  /// The point at (u, v); cheaper than jet().
  [[nodiscard]] Vec3 value(double u, double v) const;
  /// Derivatives up to second order; outside the domain the end spans' polynomials are extrapolated.
  [[nodiscard]] SurfaceJet jet(double u, double v) const;
};

/// Tensor interpolation of a grid of points (u index major, nu x nv) at the parameters u, v (both from 0 to 1), by
/// degree x degree splines with knots averaged from the parameters (Piegl and Tiller, 9.8).
[[nodiscard]] BSplineSurface interpolate_grid(const std::vector<Vec3>& points, const std::vector<double>& u,
                                              const std::vector<double>& v, int degree);

/// Tensor interpolation with clamped knots that are given: points at the Greville sites of both directions (u index
/// major). Knots may be multiple up to the degree, so that the surface is as smooth as what it goes through and no more.
[[nodiscard]] BSplineSurface interpolate_grid(const std::vector<Vec3>& points, const std::vector<double>& knots_u,
                                              const std::vector<double>& knots_v, int degree_u, int degree_v);
/// The means of `degree` neighbouring inner knots, one for each control point.
[[nodiscard]] std::vector<double> greville_sites(const std::vector<double>& knots, int degree);

}  // namespace flank
