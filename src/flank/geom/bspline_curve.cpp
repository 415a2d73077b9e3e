#include "flank/bspline_curve.h"

#include <Eigen/Cholesky>

#include "flank/base/assert.h"

namespace flank {

BSplineCurve3 fit_curve(const Eigen::Matrix3Xd& points, const std::vector<double>& t, int degree, int count) {
  FLANK_ASSERT(points.cols() == static_cast<Eigen::Index>(t.size()));
  FLANK_ASSERT(points.allFinite());
  BSplineCurve3 curve;
  curve.degree = degree;
  // Parameters are taken as they are: who asks has chosen them, by chord lengths or by time.
  curve.knots = uniform_knots(degree, count);
  // Normal equations: parameters spread over all spans keep them well conditioned, and they are small.
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(count, count);
  Eigen::MatrixX3d rhs = Eigen::MatrixX3d::Zero(count, 3);
  std::array<double, kMaxDegree + 1> n;
  for (std::size_t k = 0; k < t.size(); ++k) {
    const int span = find_span(degree, curve.knots, t[k]);
    basis_derivatives(degree, curve.knots, span, t[k], 0, n.data());
    for (int i = 0; i <= degree; ++i) {
      for (int j = 0; j <= degree; ++j) normal(span - degree + i, span - degree + j) += n[i] * n[j];
      rhs.row(span - degree + i) += n[i] * points.col(static_cast<Eigen::Index>(k)).transpose();
    }
  }
  // Second differences, so weak that data are followed to 1e-12; a control point without data continues its neighbours.
  const double mu = 1e-12 * normal.trace() / count;
  for (int i = 1; i + 1 < count; ++i) {
    const double d[3] = {1.0, -2.0, 1.0};
    for (int p = 0; p < 3; ++p)
      for (int q = 0; q < 3; ++q) normal(i - 1 + p, i - 1 + q) += mu * d[p] * d[q];
  }
  curve.poles = normal.ldlt().solve(rhs).transpose();
  return curve;
}

}  // namespace flank
