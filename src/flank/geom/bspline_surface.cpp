#include "flank/bspline_surface.h"

#include <Eigen/LU>
#include <array>

#include "flank/base/assert.h"

namespace flank {
namespace {

constexpr int kWidth = kMaxDegree + 1;

/// Basis functions of one direction: value, first and second derivatives, kMaxDegree + 1 apart at most.
struct Basis {
  int span;
  std::array<double, 3 * kWidth> n;
};

/// The span that holds t, and the functions that are not 0 there, with derivatives up to `order`.
Basis basis(int degree, const std::vector<double>& knots, double t, int order) {
  FLANK_ASSERT(order <= 2);
  Basis b;
  b.span = find_span(degree, knots, t);
  basis_derivatives(degree, knots, b.span, t, order, b.n.data());
  return b;
}

/// Quotient rule for homogeneous derivatives (Piegl and Tiller, A4.4).
SurfaceJet project(const SurfaceJet& a, const std::array<double, 6>& w) {
  SurfaceJet s;
  s.p = a.p / w[0];
  s.du = (a.du - w[1] * s.p) / w[0];
  s.dv = (a.dv - w[2] * s.p) / w[0];
  s.duu = (a.duu - 2.0 * w[1] * s.du - w[3] * s.p) / w[0];
  s.duv = (a.duv - w[1] * s.dv - w[2] * s.du - w[4] * s.p) / w[0];
  s.dvv = (a.dvv - 2.0 * w[2] * s.dv - w[5] * s.p) / w[0];
  return s;
}

/// Inner knots as means of `degree` parameters (Piegl and Tiller, 9.8): the collocation matrix stays well conditioned.
std::vector<double> averaged_knots(const std::vector<double>& t, int degree) {
  const int count = static_cast<int>(t.size());
  std::vector<double> knots(static_cast<std::size_t>(count + degree + 1), 0.0);
  for (int j = 1; j < count - degree; ++j) {
    double sum = 0.0;
    for (int i = j; i < j + degree; ++i) sum += t[static_cast<std::size_t>(i)];
    knots[static_cast<std::size_t>(j + degree)] = sum / degree;
  }
  for (int i = count; i < count + degree + 1; ++i) knots[static_cast<std::size_t>(i)] = 1.0;
  return knots;
}

/// Row k: the basis functions at t[k].
Eigen::MatrixXd collocation(const std::vector<double>& t, const std::vector<double>& knots, int degree) {
  const int count = static_cast<int>(t.size());
  Eigen::MatrixXd m = Eigen::MatrixXd::Zero(count, count);
  for (int k = 0; k < count; ++k) {
    const Basis b = basis(degree, knots, t[static_cast<std::size_t>(k)], 0);
    for (int j = 0; j <= degree; ++j) m(k, b.span - degree + j) = b.n[static_cast<std::size_t>(j)];
  }
  return m;
}

/// Solves for the poles of a surface whose knots and counts are set, and whose poles are the points at (u, v).
/// A tensor product: first along u for every column, then along v for every row, each with one factorisation.
void solve_poles(BSplineSurface& s, const std::vector<double>& u, const std::vector<double>& v) {
  FLANK_ASSERT(s.poles.size() == u.size() * v.size());
  const Eigen::PartialPivLU<Eigen::MatrixXd> lu_u(collocation(u, s.knots_u, s.degree_u));
  const Eigen::PartialPivLU<Eigen::MatrixXd> lu_v(collocation(v, s.knots_v, s.degree_v));
  for (int c = 0; c < 3; ++c) {
    Eigen::MatrixXd grid(s.count_u, s.count_v);
    for (int i = 0; i < s.count_u; ++i)
      for (int j = 0; j < s.count_v; ++j) grid(i, j) = s.pole(i, j)[c];
    grid = lu_u.solve(grid).eval();
    grid = lu_v.solve(grid.transpose()).transpose().eval();
    for (int i = 0; i < s.count_u; ++i)
      for (int j = 0; j < s.count_v; ++j) s.pole(i, j)[c] = grid(i, j);
  }
}

}  // namespace

Vec3 BSplineSurface::value(double u, double v) const {
  FLANK_ASSERT(poles.size() == static_cast<std::size_t>(count_u * count_v));
  FLANK_ASSERT(weights.empty() || weights.size() == poles.size());
  const Basis bu = basis(degree_u, knots_u, u, 0), bv = basis(degree_v, knots_v, v, 0);
  Vec3 sum = Vec3::Zero();
  double weight = 0.0;
  // Sums of b w P and of b w: their quotient is the point of a rational surface.
  for (int i = 0; i <= degree_u; ++i) {
    for (int j = 0; j <= degree_v; ++j) {
      const std::size_t k = static_cast<std::size_t>((bu.span - degree_u + i) * count_v + bv.span - degree_v + j);
      const double b = bu.n[i] * bv.n[j] * (weights.empty() ? 1.0 : weights[k]);
      sum += b * poles[k];
      weight += b;
    }
  }
  return weights.empty() ? sum : Vec3(sum / weight);
}

SurfaceJet BSplineSurface::jet(double u, double v) const {
  FLANK_ASSERT(poles.size() == static_cast<std::size_t>(count_u * count_v));
  FLANK_ASSERT(weights.empty() || weights.size() == poles.size());
  const Basis bu = basis(degree_u, knots_u, u, 2), bv = basis(degree_v, knots_v, v, 2);
  const int wu = degree_u + 1, wv = degree_v + 1;
  SurfaceJet s;
  std::array<double, 6> w{};
  for (int i = 0; i < wu; ++i) {
    // A row of poles along v first: its point and derivatives, homogeneous if the surface is rational.
    Vec3 r0 = Vec3::Zero(), r1 = Vec3::Zero(), r2 = Vec3::Zero();
    double w0 = 0.0, w1 = 0.0, w2 = 0.0;
    for (int j = 0; j < wv; ++j) {
      const std::size_t k = static_cast<std::size_t>((bu.span - degree_u + i) * count_v + bv.span - degree_v + j);
      const double weight = weights.empty() ? 1.0 : weights[k];
      const double b0 = bv.n[j] * weight, b1 = bv.n[wv + j] * weight, b2 = bv.n[2 * wv + j] * weight;
      r0 += b0 * poles[k];
      r1 += b1 * poles[k];
      r2 += b2 * poles[k];
      w0 += b0;
      w1 += b1;
      w2 += b2;
    }
    const double a0 = bu.n[i], a1 = bu.n[wu + i], a2 = bu.n[2 * wu + i];
    s.p += a0 * r0;
    s.du += a1 * r0;
    s.dv += a0 * r1;
    s.duu += a2 * r0;
    s.duv += a1 * r1;
    s.dvv += a0 * r2;
    w[0] += a0 * w0;
    w[1] += a1 * w0;
    w[2] += a0 * w1;
    w[3] += a2 * w0;
    w[4] += a1 * w1;
    w[5] += a0 * w2;
  }
  return weights.empty() ? s : project(s, w);
}

BSplineSurface interpolate_grid(const std::vector<Vec3>& points, const std::vector<double>& u,
                                const std::vector<double>& v, int degree) {
  BSplineSurface s;
  s.degree_u = s.degree_v = degree;
  s.count_u = static_cast<int>(u.size());
  s.count_v = static_cast<int>(v.size());
  s.knots_u = averaged_knots(u, degree);
  // Poles hold the points until they are solved for.
  s.knots_v = averaged_knots(v, degree);
  s.poles = points;
  solve_poles(s, u, v);
  return s;
}

std::vector<double> greville_sites(const std::vector<double>& knots, int degree) {
  FLANK_ASSERT(degree >= 1 && knots.size() > static_cast<std::size_t>(degree) + 1);
  std::vector<double> sites;
  for (std::size_t i = 0; i + static_cast<std::size_t>(degree) + 1 < knots.size(); ++i) {
    double sum = 0.0;
    for (int j = 1; j <= degree; ++j) sum += knots[i + static_cast<std::size_t>(j)];
    sites.push_back(sum / degree);
  }
  // Their sums can be off by a rounding error, and a site outside the domain would be extrapolated.
  sites.front() = knots.front();
  sites.back() = knots.back();
  return sites;
}

BSplineSurface interpolate_grid(const std::vector<Vec3>& points, const std::vector<double>& knots_u,
                                const std::vector<double>& knots_v, int degree_u, int degree_v) {
  BSplineSurface s;
  s.degree_u = degree_u;
  s.degree_v = degree_v;
  s.knots_u = knots_u;
  s.knots_v = knots_v;
  s.count_u = static_cast<int>(knots_u.size()) - degree_u - 1;
  s.count_v = static_cast<int>(knots_v.size()) - degree_v - 1;
  s.poles = points;
  // At Greville sites interpolation with given knots always has a solution (Schoenberg and Whitney).
  solve_poles(s, greville_sites(knots_u, degree_u), greville_sites(knots_v, degree_v));
  return s;
}

}  // namespace flank
