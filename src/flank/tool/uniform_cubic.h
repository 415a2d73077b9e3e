/// Clamped cubic B-spline basis with equal knots, without knot vector or allocation. Used by RadialFunction only.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "flank/base/assert.h"

namespace flank::internal {

/// The four cubic, three quadratic and two linear basis functions that do not vanish on one knot span, and what their
/// derivatives need. Knots in units of the span length h are whole numbers 0, 0, 0, 0, 1, 2, ..., spans, spans, spans,
/// spans, so every knot difference is 1, 2 or 3.
struct UniformCubic {
  int first;                           ///< index of the first active coefficient
  double inverse_h;                    ///< 1 / span length
  std::array<double, 2> n1;            ///< degree 1
  std::array<double, 3> n2;            ///< degree 2
  std::array<double, 4> n3;            ///< degree 3
  std::array<double, 3> inverse_gap3;  ///< 1 / (k_{i+3} - k_i) of the three derivative coefficients
  std::array<double, 2> inverse_gap2;

  /// Basis at s in [0, L] for `count` coefficients; outside, the end spans' polynomials.
  static UniformCubic at(double axis_length, int count, double s) {
    FLANK_ASSERT(count >= 4 && axis_length > 0.0);
    FLANK_ASSERT(!std::isnan(s));
    constexpr std::array<double, 4> kInverse = {0.0, 1.0, 0.5, 1.0 / 3.0};
    const int spans = count - 3;
    UniformCubic b;
    b.inverse_h = spans / axis_length;
    const double u = s * b.inverse_h;
    const int m = static_cast<int>(std::clamp(u, 0.0, static_cast<double>(spans - 1)));  // truncation: floor, as u >= 0
    b.first = m;
    // Distances to the knots on both sides: left[j] = u - k_{m+1-j}, right[j] = k_{m+j} - u, j = 1..3.
    const int k0 = std::max(m - 2, 0), k1 = std::max(m - 1, 0), k4 = std::min(m + 2, spans),
              k5 = std::min(m + 3, spans);
    const double l1 = u - m, l2 = u - k1, l3 = u - k0;
    const double r1 = m + 1 - u, r2 = k4 - u, r3 = k5 - u;
    b.n1 = {r1, l1};
    const double g20 = kInverse[m + 1 - k1], g21 = kInverse[k4 - m];
    b.inverse_gap2 = {g20, g21};
    b.n2 = {r1 * b.n1[0] * g20, l2 * b.n1[0] * g20 + r2 * b.n1[1] * g21, l1 * b.n1[1] * g21};
    const double g30 = kInverse[m + 1 - k0], g31 = kInverse[k4 - k1], g32 = kInverse[k5 - m];
    b.inverse_gap3 = {g30, g31, g32};
    b.n3 = {r1 * b.n2[0] * g30, l3 * b.n2[0] * g30 + r2 * b.n2[1] * g31, l2 * b.n2[1] * g31 + r3 * b.n2[2] * g32,
            l1 * b.n2[2] * g32};
    return b;
  }
};

}  // namespace flank::internal
