#include "flank/surface/mesh/scattered_spline.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "flank/base/assert.h"

namespace flank::internal {
namespace {

/// Symmetric positive definite matrix of small bandwidth: entry (i, i - d) at row i, column width - d.
class BandMatrix {
 public:
  BandMatrix(int size, int width)
      : size_(size),
        width_(width),
        entries_(static_cast<std::size_t>(size) * static_cast<std::size_t>(width + 1), 0.0) {}

  double& at(int i, int j) {  // j <= i
    return entries_[static_cast<std::size_t>(i) * static_cast<std::size_t>(width_ + 1) +
                    static_cast<std::size_t>(width_ - i + j)];
  }

  /// Cholesky factor in place.
  void factor() {
    for (int i = 0; i < size_; ++i) {
      const int first = std::max(0, i - width_);
      for (int j = first; j <= i; ++j) {
        const int from = std::max(first, j - width_);
        double sum = at(i, j);
        const double *a = &at(i, from), *b = &at(j, from);
        for (int k = 0; k < j - from; ++k) sum -= a[k] * b[k];
        at(i, j) = i == j ? std::sqrt(std::max(sum, 1e-300)) : sum / at(j, j);
      }
    }
  }

  /// Solves with the factor, in place.
  void solve(std::vector<Vec3>& x) {
    for (int i = 0; i < size_; ++i) {
      for (int j = std::max(0, i - width_); j < i; ++j)
        x[static_cast<std::size_t>(i)] -= at(i, j) * x[static_cast<std::size_t>(j)];
      x[static_cast<std::size_t>(i)] /= at(i, i);
    }
    for (int i = size_ - 1; i >= 0; --i) {
      x[static_cast<std::size_t>(i)] /= at(i, i);
      for (int j = std::max(0, i - width_); j < i; ++j)
        x[static_cast<std::size_t>(j)] -= at(i, j) * x[static_cast<std::size_t>(i)];
    }
  }

 private:
  int size_, width_;
  std::vector<double> entries_;
};

/// Adds weight * (sum_k c_k x_{index_k})^2.
template <std::size_t N>
void add_square(BandMatrix& m, const std::array<int, N>& index, const std::array<double, N>& c, double weight) {
  for (std::size_t a = 0; a < N; ++a)
    for (std::size_t b = 0; b < N; ++b)
      if (index[b] <= index[a]) m.at(index[a], index[b]) += weight * c[a] * c[b];
}

/// Squares of second differences along u, along v and across: the thin plate's energy on the control net. It decides
/// control points that no data reaches, and leaves linear nets alone.
void add_smoothing(BandMatrix& m, int nu, int nv, double weight) {
  const std::array<double, 3> second{1.0, -2.0, 1.0};
  for (int i = 0; i < nu; ++i) {
    for (int j = 0; j < nv; ++j) {
      const int k = i * nv + j;
      if (i + 2 < nu) add_square<3>(m, {k, k + nv, k + 2 * nv}, second, weight);
      if (j + 2 < nv) add_square<3>(m, {k, k + 1, k + 2}, second, weight);
      if (i + 1 < nu && j + 1 < nv) add_square<4>(m, {k, k + 1, k + nv, k + nv + 1}, {1.0, -1.0, -1.0, 1.0}, weight);
    }
  }
}

}  // namespace

BSplineSurface fit_scattered(std::span<const Vec3> points, std::span<const Vec2> parameters,
                             const ScatteredSplineOptions& options) {
  FLANK_ASSERT(!points.empty() && parameters.size() == points.size());
  BSplineSurface s;
  const int p = options.degree;
  s.degree_u = s.degree_v = p;
  s.count_u = std::max(p + 1, options.count_u);
  s.count_v = std::max(p + 1, options.count_v);
  s.knots_u = uniform_knots(p, s.count_u);
  s.knots_v = uniform_knots(p, s.count_v);
  const int size = s.count_u * s.count_v;
  s.poles.assign(static_cast<std::size_t>(size), Vec3::Zero());
  // Relative to the mean, so that the zero of the coordinates plays no part in rounding.
  Vec3 mean = Vec3::Zero();
  for (const Vec3& x : points) mean += x / static_cast<double>(points.size());
  BandMatrix normal(size, std::max(p, 2) * s.count_v + p);
  std::array<double, kMaxDegree + 1> bu, bv;
  for (std::size_t n = 0; n < points.size(); ++n) {
    const double u = std::clamp(parameters[n][0], 0.0, 1.0), v = std::clamp(parameters[n][1], 0.0, 1.0);
    const int su = find_span(p, s.knots_u, u) - p, sv = find_span(p, s.knots_v, v) - p;
    basis_derivatives(p, s.knots_u, su + p, u, 0, bu.data());
    basis_derivatives(p, s.knots_v, sv + p, v, 0, bv.data());
    for (int a = 0; a <= p; ++a) {
      for (int b = 0; b <= p; ++b) {
        const int i = (su + a) * s.count_v + sv + b;
        const double w = bu[a] * bv[b];
        s.poles[static_cast<std::size_t>(i)] += w * (points[n] - mean);
        for (int c = 0; c <= a; ++c) {
          const int row = (su + c) * s.count_v + sv;
          const int last = c == a ? b : p;
          for (int d = 0; d <= last; ++d) normal.at(i, row + d) += w * bu[c] * bv[d];
        }
      }
    }
  }
  // Relative to the mean diagonal, so that smoothing means the same for any number of points. Never quite zero, or
  // control points without data would make the matrix singular.
  double trace = 0.0;
  for (int i = 0; i < size; ++i) trace += normal.at(i, i);
  add_smoothing(normal, s.count_u, s.count_v, std::max(options.smoothing, 1e-14) * trace / size);
  normal.factor();
  normal.solve(s.poles);
  for (Vec3& pole : s.poles) pole += mean;
  return s;
}

}  // namespace flank::internal
