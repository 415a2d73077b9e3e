#include "flank/surface/mesh/jet.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "flank/base/assert.h"

namespace flank::internal {
namespace {

/// Least ratio of the pivots of the scaled normal equations. Below it the points lie (nearly) on a curve of the
/// polynomial's degree.
constexpr double kLeastPivot = 1e-9;

/// Points for each coefficient below which a degree is not tried.
constexpr double kPointsPerTerm = 1.2;

constexpr int terms_of(int degree) { return (degree + 1) * (degree + 2) / 2; }

using Basis = Eigen::Matrix<double, Jet::kTerms, 1>;

Basis monomials(double x, double y) {
  const double x2 = x * x, y2 = y * y;
  Basis b;
  b << 1.0, x, y, x2, x * y, y2, x2 * x, x2 * y, x * y2, y2 * y, x2 * x2, x2 * x * y, x2 * y2, x * y2 * y, y2 * y2;
  return b;
}

/// Turns the frame to the principal directions of the points in the tangent plane; returns the two extents.
Vec2 align(std::span<const Vec3> points, Jet& jet) {
  const Vec3 n = jet.frame.col(2), a = n.unitOrthogonal(), b = n.cross(a);
  double aa = 0.0, ab = 0.0, bb = 0.0;
  for (const Vec3& p : points) {
    const double s = a.dot(p - jet.origin), t = b.dot(p - jet.origin);
    aa += s * s;
    ab += s * t;
    bb += t * t;
  }
  const double angle = 0.5 * std::atan2(2.0 * ab, aa - bb);
  jet.frame.col(0) = std::cos(angle) * a + std::sin(angle) * b;
  jet.frame.col(1) = n.cross(Vec3(jet.frame.col(0)));
  Vec2 extent = Vec2::Zero();
  for (const Vec3& p : points) {
    extent[0] = std::max(extent[0], std::abs(jet.frame.col(0).dot(p - jet.origin)));
    extent[1] = std::max(extent[1], std::abs(jet.frame.col(1).dot(p - jet.origin)));
  }
  // Points on a line: a width to divide by, too small for the pivots to let a second direction pass.
  return extent.cwiseMax(1e-9 * extent.maxCoeff()).cwiseMax(1e-150);
}

/// One type of factor for all sizes: one of each takes twice as long to compile, and is no faster.
using Factor =
    Eigen::LLT<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, Jet::kTerms, Jet::kTerms>>;

/// Solves for the coefficients over the scaled coordinates; false if they are not determined.
template <int Terms>
bool solve(const JetWorkspace& w, Basis& solution, double& residual) {
  using Matrix = Eigen::Matrix<double, Terms, Terms>;
  using Vector = Eigen::Matrix<double, Terms, 1>;
  const std::size_t count = w.x.size();
  if (static_cast<double>(count) < kPointsPerTerm * Terms) return false;
  Matrix normal = Matrix::Zero();
  Vector right = Vector::Zero();
  for (std::size_t i = 0; i < count; ++i) {
    const Vector b = monomials(w.x[i], w.y[i]).template head<Terms>();
    const Vector wb = w.weight[i] * b;
    for (int j = 0; j < Terms; ++j) normal.col(j).tail(Terms - j) += b[j] * wb.tail(Terms - j);
    right += w.z[i] * wb;
  }
  const Vector scale = normal.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  for (int j = 0; j < Terms; ++j)
    for (int i = j; i < Terms; ++i) normal(i, j) *= scale[i] * scale[j];
  const Factor factor(normal);
  if (factor.info() != Eigen::Success) return false;
  if (factor.matrixLLT().diagonal().cwiseAbs2().minCoeff() < kLeastPivot) return false;
  Vector x = scale.cwiseProduct(factor.solve(scale.cwiseProduct(right)));
  // One step of refinement: the normal equations square the condition.
  for (int pass = 0; pass < 2; ++pass) {
    Vector rest = Vector::Zero();
    residual = 0.0;
    double total = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      const Vector b = monomials(w.x[i], w.y[i]).template head<Terms>();
      const double r = w.z[i] - b.dot(x);
      rest += (w.weight[i] * r) * b;
      residual += w.weight[i] * r * r;
      total += w.weight[i];
    }
    const double freedom = 1.0 - static_cast<double>(Terms) / static_cast<double>(count);
    residual = std::sqrt(residual / (total * freedom));
    if (pass == 0) x += scale.cwiseProduct(factor.solve(scale.cwiseProduct(rest)));
  }
  solution.setZero();
  solution.template head<Terms>() = x;
  return true;
}

int solve_best(int degree, const JetWorkspace& w, Basis& solution, double& residual) {
  if (degree >= 4 && solve<terms_of(4)>(w, solution, residual)) return 4;
  if (degree >= 3 && solve<terms_of(3)>(w, solution, residual)) return 3;
  if (degree >= 2 && solve<terms_of(2)>(w, solution, residual)) return 2;
  if (degree >= 1 && solve<terms_of(1)>(w, solution, residual)) return 1;
  solution.setZero();
  residual = 0.0;
  return 0;
}

}  // namespace

JetFit fit_jet(std::span<const Vec3> points, const Vec3& origin, const Vec3& normal, int degree, double falloff,
               JetWorkspace& workspace) {
  FLANK_ASSERT(degree >= 0 && degree <= Jet::kDegree);
  FLANK_ASSERT(falloff >= 0.0);
  JetFit fit;
  fit.jet.origin = origin;
  fit.jet.frame.col(2) = normal;
  const Vec2 extent = align(points, fit.jet);
  JetWorkspace& w = workspace;
  w.x.clear();
  w.y.clear();
  w.z.clear();
  w.weight.clear();
  double farthest = 1e-300;
  for (const Vec3& p : points) {
    const Vec3 local = fit.jet.frame.transpose() * (p - origin);
    w.x.push_back(local[0] / extent[0]);
    w.y.push_back(local[1] / extent[1]);
    w.z.push_back(local[2]);
    farthest = std::max(farthest, w.x.back() * w.x.back() + w.y.back() * w.y.back());
  }
  for (std::size_t i = 0; i < w.x.size(); ++i)
    w.weight.push_back(std::exp(-falloff * (w.x[i] * w.x[i] + w.y[i] * w.y[i]) / farthest));
  Basis solution;
  fit.degree = solve_best(degree, w, solution, fit.residual);
  // A plane: the coefficients stay zero. Of points that are all the origin there is no extent to scale them with.
  if (fit.degree == 0) return fit;
  const double sx = 1.0 / extent[0], sy = 1.0 / extent[1];
  const Basis scale = monomials(sx, sy);
  for (int k = 0; k < Jet::kTerms; ++k) fit.jet.c[static_cast<std::size_t>(k)] = solution[k] * scale[k];
  return fit;
}

}  // namespace flank::internal
