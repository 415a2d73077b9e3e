/// B-spline basis functions (Piegl and Tiller, The NURBS Book, A2.1-A2.3).
#pragma once

#include <span>
#include <vector>

namespace flank {

/// Largest degree that the fixed-size scratch of the evaluators holds. Files with more are refused by io.
inline constexpr int kMaxDegree = 15;

/// Clamped knots with equal interior spacing over [a, b] for `count` control points.
[[nodiscard]] std::vector<double> uniform_knots(int degree, int count, double a = 0.0, double b = 1.0);

/// Index k with knots[k] <= u < knots[k+1] (the last non-empty span at the right end; u outside is clamped to the end
/// spans).
[[nodiscard]] int find_span(int degree, std::span<const double> knots, double u);

/// Basis functions that do not vanish on `span`, and their derivatives up to `order`: out[k * (degree + 1) + j] is the
/// k-th derivative of N_{span - degree + j} at u. u outside the span extrapolates its polynomial.
void basis_derivatives(int degree, std::span<const double> knots, int span, double u, int order, double* out);

}  // namespace flank
