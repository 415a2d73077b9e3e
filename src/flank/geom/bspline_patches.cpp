#include "flank/geom/bspline_patches.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "flank/base/assert.h"

namespace flank::internal {
namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxDegree + 1, kMaxDegree + 1>;

using Pair = Eigen::Array2d;  // two doubles: one vector register
using PairMap = Eigen::Map<const Pair>;

/// Value and derivatives up to second order of one cell, out = [S, S_s, S_t, S_ss, S_st, S_tt][4]: Horner in t within
/// Horner in s, two components at a time so that all running sums stay in registers. P < 0: the degree in s is known at
/// run time only.
template <int P>
void horner(const double* c, int p_run, int q, double s, double t, double* out) {
  const int p = P < 0 ? p_run : P;
  for (int half = 0; half < 4; half += 2) {
    Pair f = Pair::Zero(), fs = f, ft = f, fss = f, fst = f, ftt = f;
    for (int i = p; i >= 0; --i) {
      const double* row = c + 4 * (i * (q + 1) + q) + half;
      Pair a = PairMap(row), b = Pair::Zero(), e = b;
      for (int j = q - 1; j >= 0; --j) {
        row -= 4;
        // a, b, e: value, first and half the second derivative of the inner polynomial, each from the one before.
        e = e * t + b;
        b = b * t + a;
        a = a * t + PairMap(row);
      }
      fss = fss * s + fs;
      fs = fs * s + f;
      f = f * s + a;
      fst = fst * s + ft;
      ft = ft * s + b;
      ftt = ftt * s + e;
    }
    // Horner's scheme gives half of the second derivatives.
    const std::array<Pair, 6> all{f, fs, ft, fss + fss, fst, ftt + ftt};
    for (int k = 0; k < 6; ++k) Eigen::Map<Pair>(out + 4 * k + half) = all[static_cast<std::size_t>(k)];
  }
}

/// Degrees 1 to 5 are compiled in, because nearly all CAD faces have them.
auto select_kernel(int p) {
  switch (p) {
    case 1:
      return &horner<1>;
    case 2:
      return &horner<2>;
    case 3:
      return &horner<3>;
    case 4:
      return &horner<4>;
    case 5:
      return &horner<5>;
    default:
      return &horner<-1>;
  }
}

/// Row k: the derivatives D^k N_j(mid) half^k / k! of the basis functions of a span.
Matrix power_basis(int degree, const std::vector<double>& knots, double mid, double half) {
  const int width = degree + 1;
  std::array<double, (kMaxDegree + 1) * (kMaxDegree + 1)> n;
  basis_derivatives(degree, knots, find_span(degree, knots, mid), mid, degree, n.data());
  Matrix m(width, width);
  double scale = 1.0;
  for (int k = 0; k < width; ++k) {
    if (k > 0) scale *= half / k;
    for (int j = 0; j < width; ++j) m(k, j) = n[static_cast<std::size_t>(k * width + j)] * scale;
  }
  return m;
}

/// Maps powers on [-1, 1] to Bernstein coefficients on [a, b].
Matrix to_bernstein(int degree, double a, double b) {
  const int width = degree + 1;
  // Powers of s = m + h x with x in [-1, 1], then x = 2 y - 1 with y in [0, 1], as one affine map s = a + (b - a) y.
  Matrix affine = Matrix::Zero(width, width);  // row: power of y, column: power of s
  affine(0, 0) = 1.0;
  // Column k is column k - 1 times (a + (b - a) y).
  for (int k = 1; k < width; ++k)
    for (int i = 0; i <= k; ++i) affine(i, k) = a * affine(i, k - 1) + (i > 0 ? (b - a) * affine(i - 1, k - 1) : 0.0);
  Matrix bernstein = Matrix::Zero(width, width);  // b_i = sum_k C(i, k) / C(degree, k) a_k
  for (int i = 0; i < width; ++i) {
    double ratio = 1.0;
    for (int k = 0; k <= i; ++k) {
      bernstein(i, k) = ratio;
      // C(i, k) / C(degree, k), from k to k + 1; where k = degree the product is not used any more.
      ratio *= static_cast<double>(i - k) / static_cast<double>(degree - k > 0 ? degree - k : 1);
    }
  }
  return bernstein * affine;
}

}  // namespace

BSplinePatches::Axis::Axis(int degree_, int count, const std::vector<double>& knots) : degree(degree_) {
  FLANK_ASSERT(knots.size() == static_cast<std::size_t>(count + degree + 1));
  // Knots of several folds bound cells of no width: these are left out.
  for (int k = degree; k <= count; ++k) {
    const double knot = knots[static_cast<std::size_t>(k)];
    if (breaks.empty() || knot > breaks.back()) breaks.push_back(knot);
  }
  const std::size_t n = breaks.size() - 1;
  for (std::size_t k = 0; k < n; ++k) {
    mid.push_back(0.5 * (breaks[k] + breaks[k + 1]));
    inverse_half.push_back(2.0 / (breaks[k + 1] - breaks[k]));
  }
  // Twice as many slots as cells: on evenly spaced knots find() needs one comparison each way.
  const std::size_t slots = 2 * n;
  slots_per_unit = static_cast<double>(slots) / (breaks.back() - breaks.front());
  for (std::size_t s = 0, k = 0; s < slots; ++s) {
    const double left = breaks.front() + static_cast<double>(s) / slots_per_unit;
    while (k + 1 < n && breaks[k + 1] <= left) ++k;
    start.push_back(static_cast<int>(k));
  }
}

int BSplinePatches::Axis::find(double u) const {
  const int n = static_cast<int>(mid.size());
  const double slot = (u - breaks.front()) * slots_per_unit;
  // NaN, too.
  if (!(slot > 0.0)) return 0;
  // The table says where to begin: the two loops make good what rounding or uneven knots leave.
  int k = slot >= static_cast<double>(start.size()) ? n - 1 : start[static_cast<std::size_t>(slot)];
  while (k > 0 && u < breaks[static_cast<std::size_t>(k)]) --k;
  while (k + 1 < n && u >= breaks[static_cast<std::size_t>(k) + 1]) ++k;
  return k;
}

BSplinePatches::BSplinePatches(const BSplineSurface& surface)
    : u_(surface.degree_u, surface.count_u, surface.knots_u),
      v_(surface.degree_v, surface.count_v, surface.knots_v),
      rational_(!surface.weights.empty()) {
  const int p = u_.degree, q = v_.degree;
  cell_size_ = static_cast<std::size_t>(4 * (p + 1) * (q + 1));
  coefficients_.assign(cell_size_ * static_cast<std::size_t>(cells_u() * cells_v()), 0.0);
  std::vector<Matrix> basis_v;
  // Once for all cells of the same v.
  for (double mid : v_.mid)
    basis_v.push_back(
        power_basis(q, surface.knots_v, mid, 1.0 / v_.inverse_half[static_cast<std::size_t>(cell_v(mid))]));
  double* out = coefficients_.data();
  for (int i = 0; i < cells_u(); ++i) {
    const double mid_u = u_.mid[static_cast<std::size_t>(i)];
    const Matrix basis_u = power_basis(p, surface.knots_u, mid_u, 1.0 / u_.inverse_half[static_cast<std::size_t>(i)]);
    const int first_u = find_span(p, surface.knots_u, mid_u) - p;
    for (int j = 0; j < cells_v(); ++j, out += cell_size_) {
      const int first_v = find_span(q, surface.knots_v, v_.mid[static_cast<std::size_t>(j)]) - q;
      for (int d = 0; d < (rational_ ? 4 : 3); ++d) {
        Matrix poles(p + 1, q + 1);
        for (int a = 0; a <= p; ++a)
          for (int b = 0; b <= q; ++b) {
            const std::size_t k = static_cast<std::size_t>((first_u + a) * surface.count_v + first_v + b);
            const double w = surface.weights.empty() ? 1.0 : surface.weights[k];
            poles(a, b) = d < 3 ? w * surface.poles[k][d] : w;
          }
        // Taylor coefficients at the middle of the cell, in powers of its coordinates.
        const Matrix c = basis_u * poles * basis_v[static_cast<std::size_t>(j)].transpose();
        for (int b = 0; b <= q; ++b)
          for (int a = 0; a <= p; ++a) out[(a * (q + 1) + b) * 4 + d] = c(a, b);
      }
    }
  }
  kernel_ = select_kernel(p);
}

void BSplinePatches::evaluate(int i, int j, double u, double v, SurfaceJet& jet) const {
  FLANK_ASSERT(i >= 0 && i < cells_u() && j >= 0 && j < cells_v());
  const auto ku = static_cast<std::size_t>(i), kv = static_cast<std::size_t>(j);
  const double gu = u_.inverse_half[ku], gv = v_.inverse_half[kv];
  // Six derivatives of x, y, z and weight, by the cell's own coordinates: the chain rule multiplies by 1 / half width.
  double o[24];
  kernel_(cell(i, j), u_.degree, v_.degree, (u - u_.mid[ku]) * gu, (v - v_.mid[kv]) * gv, o);
  jet.p = Vec3(o[0], o[1], o[2]);
  jet.du = gu * Vec3(o[4], o[5], o[6]);
  jet.dv = gv * Vec3(o[8], o[9], o[10]);
  jet.duu = gu * gu * Vec3(o[12], o[13], o[14]);
  jet.duv = gu * gv * Vec3(o[16], o[17], o[18]);
  jet.dvv = gv * gv * Vec3(o[20], o[21], o[22]);
  if (!rational_) return;
  // Quotient rule (Piegl and Tiller, A4.4).
  const double iw = 1.0 / o[3], wu = gu * o[7], wv = gv * o[11];
  const double wuu = gu * gu * o[15], wuv = gu * gv * o[19], wvv = gv * gv * o[23];
  jet.p *= iw;
  jet.du = (jet.du - wu * jet.p) * iw;
  jet.dv = (jet.dv - wv * jet.p) * iw;
  jet.duu = (jet.duu - 2.0 * wu * jet.du - wuu * jet.p) * iw;
  jet.duv = (jet.duv - wu * jet.dv - wv * jet.du - wuv * jet.p) * iw;
  jet.dvv = (jet.dvv - 2.0 * wv * jet.dv - wvv * jet.p) * iw;
}

std::vector<Vec3> BSplinePatches::hull(int i, int j, double u0, double u1, double v0, double v1) const {
  FLANK_ASSERT(i >= 0 && i < cells_u() && j >= 0 && j < cells_v());
  const auto ku = static_cast<std::size_t>(i), kv = static_cast<std::size_t>(j);
  const int p = u_.degree, q = v_.degree;
  const Matrix bu = to_bernstein(p, (u0 - u_.mid[ku]) * u_.inverse_half[ku], (u1 - u_.mid[ku]) * u_.inverse_half[ku]);
  const Matrix bv = to_bernstein(q, (v0 - v_.mid[kv]) * v_.inverse_half[kv], (v1 - v_.mid[kv]) * v_.inverse_half[kv]);
  const double* c = cell(i, j);
  // Weight 1 where the surface is not rational: then the division below changes nothing.
  std::vector<Eigen::Vector4d> homogeneous(static_cast<std::size_t>((p + 1) * (q + 1)), Eigen::Vector4d(0, 0, 0, 1));
  for (int d = 0; d < (rational_ ? 4 : 3); ++d) {
    Matrix power(p + 1, q + 1);
    for (int b = 0; b <= q; ++b)
      for (int a = 0; a <= p; ++a) power(a, b) = c[(a * (q + 1) + b) * 4 + d];
    const Matrix bezier = bu * power * bv.transpose();
    for (int a = 0; a <= p; ++a)
      for (int b = 0; b <= q; ++b) homogeneous[static_cast<std::size_t>(a * (q + 1) + b)][d] = bezier(a, b);
  }
  std::vector<Vec3> points;
  points.reserve(homogeneous.size());
  for (const Eigen::Vector4d& h : homogeneous) points.push_back(h.head<3>() / h[3]);
  return points;
}

}  // namespace flank::internal
