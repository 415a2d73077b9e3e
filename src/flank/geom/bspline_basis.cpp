#include "flank/bspline_basis.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "flank/base/assert.h"

namespace flank {

std::vector<double> uniform_knots(int degree, int count, double a, double b) {
  FLANK_ASSERT(degree >= 0 && degree <= kMaxDegree);
  FLANK_ASSERT(count > degree);
  FLANK_ASSERT(a < b);
  std::vector<double> knots(static_cast<std::size_t>(count + degree + 1));
  // Clamped: the first and last knots are degree + 1 times there, so that the ends are control points.
  const int spans = count - degree;
  for (int i = 0; i < count + degree + 1; ++i) {
    const int k = std::clamp(i - degree, 0, spans);
    // The end is b itself: a + (b - a) may differ from it in the last bit, and parameters at b would fall outside.
    knots[static_cast<std::size_t>(i)] = k == spans ? b : a + (b - a) * k / spans;
  }
  return knots;
}

int find_span(int degree, std::span<const double> knots, double u) {
  FLANK_ASSERT(degree >= 0 && degree <= kMaxDegree);
  FLANK_ASSERT(knots.size() >= 2 * static_cast<std::size_t>(degree) + 2);
  FLANK_ASSERT(!std::isnan(u));
  const int count = static_cast<int>(knots.size()) - degree - 1;
  const auto first = knots.begin() + degree;
  const auto last = knots.begin() + count + 1;
  // upper_bound: a knot belongs to the span on its right.
  int span = static_cast<int>(std::upper_bound(first, last, u) - knots.begin()) - 1;
  span = std::clamp(span, degree, count - 1);
  // Past empty spans: at the end of the domain to the left, else to the right.
  while (span > degree && knots[span] == knots[span + 1]) --span;
  while (span < count - 1 && knots[span] == knots[span + 1]) ++span;
  return span;
}

namespace {

/// The values alone, to the last bit as basis_derivatives has them: A2.2 of the book, without the triangle of differences
/// that only derivatives need. Most of what is asked are values.
void basis_values(int degree, std::span<const double> knots, int span, double u, double* out) {
  std::array<double, kMaxDegree + 1> left, right;
  out[0] = 1.0;
  for (int j = 1; j <= degree; ++j) {
    left[j] = u - knots[span + 1 - j];
    right[j] = knots[span + j] - u;
    double saved = 0.0;
    for (int r = 0; r < j; ++r) {
      const double temp = out[r] / (right[r + 1] + left[j - r]);
      out[r] = saved + right[r + 1] * temp;
      saved = left[j - r] * temp;
    }
    out[j] = saved;
  }
}

}  // namespace

void basis_derivatives(int degree, std::span<const double> knots, int span, double u, int order, double* out) {
  FLANK_ASSERT(degree >= 0 && degree <= kMaxDegree);
  FLANK_ASSERT(span >= degree && static_cast<std::size_t>(span + degree) < knots.size());
  FLANK_ASSERT(order >= 0 && !std::isnan(u));
  if (order == 0) return basis_values(degree, knots, span, u, out);
  constexpr int kOrder = kMaxDegree + 1;
  // Not initialised: what is read below has been written, and clearing 2 kB would cost more than the evaluation.
  std::array<std::array<double, kOrder>, kOrder> ndu;
  std::array<double, kOrder> left, right;
  // A2.3 of the book. ndu: basis functions of all lower degrees (upper triangle) and knot differences (lower one).
  ndu[0][0] = 1.0;
  for (int j = 1; j <= degree; ++j) {
    left[j] = u - knots[span + 1 - j];
    right[j] = knots[span + j] - u;
    double saved = 0.0;
    for (int r = 0; r < j; ++r) {
      ndu[j][r] = right[r + 1] + left[j - r];
      const double temp = ndu[r][j - 1] / ndu[j][r];
      ndu[r][j] = saved + right[r + 1] * temp;
      saved = left[j - r] * temp;
    }
    ndu[j][j] = saved;
  }
  for (int j = 0; j <= degree; ++j) out[j] = ndu[j][degree];
  // Derivatives beyond the degree are 0.
  const int top = std::min(order, degree);
  for (int k = top + 1; k <= order; ++k) std::fill_n(out + k * (degree + 1), degree + 1, 0.0);
  for (int r = 0; r <= degree; ++r) {
    int s1 = 0, s2 = 1;
    // Rows a[s1] and a[s2] hold the coefficients of the last and of this derivative, in turn.
    std::array<std::array<double, kOrder>, 2> a;
    a[0][0] = 1.0;
    for (int k = 1; k <= top; ++k) {
      double d = 0.0;
      const int rk = r - k, pk = degree - k;
      if (r >= k) {
        a[s2][0] = a[s1][0] / ndu[pk + 1][rk];
        d = a[s2][0] * ndu[rk][pk];
      }
      const int j1 = rk >= -1 ? 1 : -rk;
      const int j2 = r - 1 <= pk ? k - 1 : degree - r;
      for (int j = j1; j <= j2; ++j) {
        a[s2][j] = (a[s1][j] - a[s1][j - 1]) / ndu[pk + 1][rk + j];
        d += a[s2][j] * ndu[rk + j][pk];
      }
      if (r <= pk) {
        a[s2][k] = -a[s1][k - 1] / ndu[pk + 1][r];
        d += a[s2][k] * ndu[r][pk];
      }
      out[k * (degree + 1) + r] = d;
      std::swap(s1, s2);
    }
  }
  // degree (degree - 1) ... (degree - k + 1), left out above.
  double factor = degree;
  for (int k = 1; k <= top; ++k) {
    for (int j = 0; j <= degree; ++j) out[k * (degree + 1) + j] *= factor;
    factor *= degree - k;
  }
}

}  // namespace flank
