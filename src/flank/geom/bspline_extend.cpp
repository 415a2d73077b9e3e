#include "flank/geom/bspline_extend.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

#include "flank/base/assert.h"

namespace flank::internal {
namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic>;

/// One direction of a surface as curves that share their knots: a column of `poles` is one control point of all curves,
/// in homogeneous coordinates.
struct Sheaf {
  int degree = 0;
  std::vector<double> knots;
  Rows poles;  ///< 4 * curves rows, one column a control point
};

/// Samples per iso-line of the least-squares fit.
constexpr int kFitSamples = 32;
/// An extrapolated weight below this share of the border's would pull the surface towards a pole: no extension then.
constexpr double kSmallestWeightShare = 0.1;

/// Coefficients c_1, c_2 (columns) of the least-squares polynomial p(x) = p(0) + c_1 x + c_2 x^2, x being the distance
/// inwards from the upper end.
Rows fit_outer(const Sheaf& s, double reach) {
  const int count = static_cast<int>(s.poles.cols()), order = std::min(2, s.degree);
  const double end = s.knots[static_cast<std::size_t>(count)];
  Eigen::MatrixXd design(kFitSamples, order);
  Rows difference(s.poles.rows(), kFitSamples);
  std::array<double, kMaxDegree + 1> n;
  for (int k = 0; k < kFitSamples; ++k) {
    const double x = reach * (k + 1) / kFitSamples;
    const int span = find_span(s.degree, s.knots, end - x);
    basis_derivatives(s.degree, s.knots, span, end - x, 0, n.data());
    difference.col(k) = -s.poles.col(count - 1);
    for (int j = 0; j <= s.degree; ++j) difference.col(k) += n[j] * s.poles.col(span - s.degree + j);
    for (int m = 0; m < order; ++m) design(k, m) = std::pow(x / reach, m + 1);
  }
  const Eigen::MatrixXd solution = design.colPivHouseholderQr().solve(difference.transpose());
  Rows c = solution.transpose();
  for (int m = 0; m < order; ++m) c.col(m) /= std::pow(reach, m + 1);
  return c;
}

/// Adds a Bezier cell of length `margin` at the upper end.
void extend_upper(Sheaf& s, double margin, double fit_share) {
  const int count = static_cast<int>(s.poles.cols());
  const double end = s.knots[static_cast<std::size_t>(count)];
  const double first = s.knots[static_cast<std::size_t>(s.degree)];
  const Rows c = fit_outer(s, fit_share * (end - first));
  Rows cell(s.poles.rows(), s.degree);
  for (int k = 1; k <= s.degree; ++k) {  // b_k = sum_m C(k, m) / C(degree, m) a_m, a_m = c_m (-margin)^m
    cell.col(k - 1) = s.poles.col(count - 1) - c.col(0) * margin * k / s.degree;
    if (c.cols() > 1) cell.col(k - 1) += c.col(1) * margin * margin * (k * (k - 1.0)) / (s.degree * (s.degree - 1.0));
  }
  for (int r = 3; r < cell.rows(); r += 4)
    if (cell.row(r).minCoeff() < kSmallestWeightShare * s.poles(r, count - 1)) return;
  Rows poles(s.poles.rows(), count + s.degree);
  poles << s.poles, cell;
  s.poles = poles;
  s.knots.pop_back();
  s.knots.insert(s.knots.end(), static_cast<std::size_t>(s.degree) + 1, end + margin);
}

/// The same curves from the other end, so that only the upper end has to be extended.
void reverse(Sheaf& s) {
  std::reverse(s.knots.begin(), s.knots.end());
  for (double& k : s.knots) k = -k;
  s.poles = s.poles.rowwise().reverse().eval();
}

void extend_both(Sheaf& s, double low, double high, double fit_share) {
  Sheaf original = s;  // both ends are fitted to the original
  if (high > 0.0) extend_upper(s, high, fit_share);
  if (!(low > 0.0)) return;
  reverse(original);
  const auto before = original.poles.cols();
  extend_upper(original, low, fit_share);
  const auto added = original.poles.cols() - before;
  if (added == 0) return;
  reverse(s);
  Rows poles(s.poles.rows(), s.poles.cols() + added);
  poles << s.poles, original.poles.rightCols(added);
  s.poles = poles;
  const double end = s.knots.back() + low;
  s.knots.pop_back();
  s.knots.insert(s.knots.end(), static_cast<std::size_t>(s.degree) + 1, end);
  reverse(s);
}

/// The curves along u, one for each row of control points along v.
Sheaf sheaf_u(const BSplineSurface& b) {
  Sheaf s{b.degree_u, b.knots_u, Rows(4 * b.count_v, b.count_u)};
  for (int i = 0; i < b.count_u; ++i)
    for (int j = 0; j < b.count_v; ++j) {
      const double w = b.weights.empty() ? 1.0 : b.weights[static_cast<std::size_t>(i * b.count_v + j)];
      s.poles.block(4 * j, i, 4, 1) << w * b.pole(i, j), w;
    }
  return s;
}

BSplineSurface from_sheaf_u(const Sheaf& s, const BSplineSurface& like) {
  BSplineSurface b = like;
  b.knots_u = s.knots;
  b.count_u = static_cast<int>(s.poles.cols());
  b.poles.assign(static_cast<std::size_t>(b.count_u * b.count_v), Vec3::Zero());
  if (!b.weights.empty()) b.weights.assign(b.poles.size(), 1.0);
  for (int i = 0; i < b.count_u; ++i)
    for (int j = 0; j < b.count_v; ++j) {
      const double w = s.poles(4 * j + 3, i);
      b.pole(i, j) = s.poles.block(4 * j, i, 3, 1) / (b.weights.empty() ? 1.0 : w);
      if (!b.weights.empty()) b.weights[static_cast<std::size_t>(i * b.count_v + j)] = w;
    }
  return b;
}

/// u and v swapped.
BSplineSurface transpose(const BSplineSurface& b) {
  BSplineSurface t;
  t.degree_u = b.degree_v;
  t.degree_v = b.degree_u;
  t.knots_u = b.knots_v;
  t.knots_v = b.knots_u;
  t.count_u = b.count_v;
  t.count_v = b.count_u;
  for (int j = 0; j < b.count_v; ++j)
    for (int i = 0; i < b.count_u; ++i) {
      t.poles.push_back(b.pole(i, j));
      if (!b.weights.empty()) t.weights.push_back(b.weights[static_cast<std::size_t>(i * b.count_v + j)]);
    }
  return t;
}

BSplineSurface extend_u(const BSplineSurface& b, double low, double high, double fit_share) {
  Sheaf s = sheaf_u(b);
  extend_both(s, low, high, fit_share);
  return from_sheaf_u(s, b);
}

}  // namespace

BSplineSurface extend(const BSplineSurface& surface, const ParameterMargins& margins, double fit_share) {
  FLANK_ASSERT(fit_share > 0.0 && fit_share <= 1.0);
  const BSplineSurface wide = extend_u(surface, margins.u_low, margins.u_high, fit_share);
  return transpose(extend_u(transpose(wide), margins.v_low, margins.v_high, fit_share));
}

}  // namespace flank::internal
