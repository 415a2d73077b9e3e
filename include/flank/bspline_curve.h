/// B-spline curves: rails of a motion (3D), trims in a parameter plane (2D), radial functions (1D).
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "flank/bspline_basis.h"

namespace flank {

/// Value and the first two derivatives of a curve.
template <int Dim>
struct CurveJet {
  using Point = Eigen::Matrix<double, Dim, 1>;
  Point p = Point::Zero(), d1 = Point::Zero(), d2 = Point::Zero();
};

/// A non-periodic B-spline curve of clamped knots; rational if `weights` is not empty.
template <int Dim>
struct BSplineCurve {
  using Point = Eigen::Matrix<double, Dim, 1>;
  int degree = 3;
  /// count() + degree + 1 of them, never falling; the first and the last degree + 1 are equal.
  std::vector<double> knots;
  Eigen::Matrix<double, Dim, Eigen::Dynamic> poles;  ///< one column a control point
  /// One per control point, > 0; empty: polynomial.
  std::vector<double> weights;

  /// Number of control points.
  [[nodiscard]] int count() const { return static_cast<int>(poles.cols()); }
  /// Domain [first(), last()]; outside it value() and jet() extrapolate the end polynomials.
  [[nodiscard]] double first() const { return knots[static_cast<std::size_t>(degree)]; }
  [[nodiscard]] double last() const { return knots[static_cast<std::size_t>(count())]; }
  /// The point at t; allocates nothing.
  [[nodiscard]] Point value(double t) const {
    const int span = find_span(degree, knots, t);
    std::array<double, kMaxDegree + 1> n;
    basis_derivatives(degree, knots, span, t, 0, n.data());
    Point p = Point::Zero();
    double w = 0.0;
    for (int j = 0; j <= degree; ++j) {
      const int i = span - degree + j;
      const double b = weights.empty() ? n[j] : n[j] * weights[static_cast<std::size_t>(i)];
      p += b * poles.col(i);
      w += b;
    }
    return weights.empty() ? p : Point(p / w);
  }

  /// Value, first and second derivative at t (extrapolated outside the domain).
  [[nodiscard]] CurveJet<Dim> jet(double t) const {
    const int span = find_span(degree, knots, t);
    std::array<double, 3 * (kMaxDegree + 1)> n;
    basis_derivatives(degree, knots, span, t, 2, n.data());
    const int width = degree + 1;
    CurveJet<Dim> c;
    double w = 0.0, w1 = 0.0, w2 = 0.0;
    for (int j = 0; j < width; ++j) {
      const int i = span - degree + j;
      const double weight = weights.empty() ? 1.0 : weights[static_cast<std::size_t>(i)];
      const double b0 = n[j] * weight, b1 = n[width + j] * weight, b2 = n[2 * width + j] * weight;
      c.p += b0 * poles.col(i);
      c.d1 += b1 * poles.col(i);
      c.d2 += b2 * poles.col(i);
      w += b0;
      w1 += b1;
      w2 += b2;
    }
    if (weights.empty()) return c;
    c.p /= w;
    c.d1 = (c.d1 - w1 * c.p) / w;
    c.d2 = (c.d2 - 2.0 * w1 * c.d1 - w2 * c.p) / w;
    return c;
  }
};

using BSplineCurve2 = BSplineCurve<2>;
using BSplineCurve3 = BSplineCurve<3>;

/// Least-squares B-spline curve through `points` (one column each) at parameters `t` in [0, 1], with `count` control
/// points; interpolates when count equals the number of points. A tiny second-difference term (1e-12) keeps control
/// points without data determined.
[[nodiscard]] BSplineCurve3 fit_curve(const Eigen::Matrix3Xd& points, const std::vector<double>& t, int degree,
                                      int count);

}  // namespace flank
