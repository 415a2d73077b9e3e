#include "flank/verify/proof/patch_bounds.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

namespace flank::internal::verify {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr int kWidth = kMaxDegree + 1;

/// Row i: how the i-th Bezier control point over [low, high] is made of the degree + 1 control points that act on the
/// span.
struct BezierMatrix {
  int width = 0;
  std::array<double, kWidth * kWidth> at;  // NOLINT(*-member-init): of `width` rows, as long

  [[nodiscard]] double operator()(int i, int j) const { return at[static_cast<std::size_t>(i * width + j)]; }
};

/// A level of de Boor's recursion at t, for rows that say how each value is made of the control points. W: the degree + 1.
template <int W>
void de_boor_level(const double* knots, int level, double t, double* rows) {
  for (int j = W - 1; j >= level; --j) {
    const double alpha = (t - knots[j]) / (knots[j + W - level] - knots[j]);
    const double* before = rows + static_cast<std::ptrdiff_t>(j - 1) * W;
    double* row = rows + static_cast<std::ptrdiff_t>(j) * W;
    for (int c = 0; c < W; ++c) row[c] = (1.0 - alpha) * before[c] + alpha * row[c];
  }
}

/// By the blossom: de Boor's recursion at `low` in its first levels and at `high` in the others. The levels at `low` are
/// common to all.
template <int W>
void fill(const double* knots, double low, double high, double* out) {
  std::array<double, W * W> common{};
  for (std::size_t i = 0; i < W; ++i) common[i * W + i] = 1.0;
  for (int i = W - 1; i >= 0; --i) {
    std::array<double, W* W> rows = common;
    for (int level = W - i; level < W; ++level) de_boor_level<W>(knots, level, high, rows.data());
    std::copy_n(rows.end() - W, W, out + static_cast<std::ptrdiff_t>(i) * W);
    if (i > 0) de_boor_level<W>(knots, W - i, low, common.data());
  }
}

/// Each degree has its own loops, of known lengths.
template <int W>
void fill_of_width(int width, const double* knots, double low, double high, double* out) {
  if (width == W) return fill<W>(knots, low, high, out);
  if constexpr (W < kWidth) fill_of_width<W + 1>(width, knots, low, high, out);
}

/// A matrix and what it was made of: the knots that act on its span, and the stretch of it.
struct KnownMatrix {
  std::array<double, 2 * kMaxDegree> knots{};
  double low = 0.0, high = 0.0;
  BezierMatrix matrix;

  [[nodiscard]] bool is_of(const double* at, int degree, double from, double to) const {
    return matrix.width == degree + 1 && low == from && high == to && std::equal(at, at + 2 * degree, knots.begin());
  }
};

/// Cells stand in rows and columns, so most matrices are soon asked for again: the last ones are kept, of each direction
/// and by each thread its own, at a place that the stretch says. Valid until the next that is asked for in this direction.
const BezierMatrix& bezier_matrix(const std::vector<double>& knots, int degree, int span, double low, double high,
                                  bool along_u) {
  constexpr std::size_t kKept = 256;
  thread_local std::array<std::vector<KnownMatrix>, 2> kept{std::vector<KnownMatrix>(kKept),
                                                            std::vector<KnownMatrix>(kKept)};
  const std::uint64_t bits = (std::bit_cast<std::uint64_t>(low) ^ std::rotl(std::bit_cast<std::uint64_t>(high), 29)) *
                             0x9E3779B97F4A7C15ULL;  // of the golden ratio
  KnownMatrix& known = kept[along_u ? 1 : 0][(bits >> 40U) % kKept];
  const double* acting = knots.data() + (span - degree) + 1;
  if (known.is_of(acting, degree, low, high)) return known.matrix;
  std::copy_n(acting, 2 * degree, known.knots.begin());
  known.low = low;
  known.high = high;
  known.matrix.width = degree + 1;
  fill_of_width<1>(known.matrix.width, acting - 1, low, high, known.matrix.at.data());
  return known.matrix;
}

/// A net of control points in homogeneous coordinates, relative to an origin: w (P - origin), and w.
struct Net {
  int rows = 0, columns = 0;
  std::array<Eigen::Vector4d, kWidth * kWidth> c;  ///< of `rows` rows, `columns` long

  [[nodiscard]] Eigen::Vector4d& at(int i, int j) { return c[static_cast<std::size_t>(i * columns + j)]; }
  [[nodiscard]] const Eigen::Vector4d& at(int i, int j) const { return c[static_cast<std::size_t>(i * columns + j)]; }
  [[nodiscard]] std::span<const Eigen::Vector4d> all() const {
    return {c.data(), static_cast<std::size_t>(rows * columns)};
  }
  [[nodiscard]] double least_weight() const {
    double least = kInfinite;
    for (const Eigen::Vector4d& p : all()) least = std::min(least, p.w());
    return least;
  }
};

/// The control points that act on a pair of spans.
void poles_at(const BSplineSurface& s, int span_u, int span_v, const Vec3& origin, Net& poles) {
  poles.rows = s.degree_u + 1;
  poles.columns = s.degree_v + 1;
  for (int i = 0; i < poles.rows; ++i) {
    for (int j = 0; j < poles.columns; ++j) {
      const int at_u = span_u - s.degree_u + i, at_v = span_v - s.degree_v + j;
      const double w = s.weights.empty() ? 1.0 : s.weights[static_cast<std::size_t>(at_u * s.count_v + at_v)];
      poles.at(i, j) << w * (s.pole(at_u, at_v) - origin), w;
    }
  }
}

/// u poles v^T: the Bezier net over a rectangle inside one knot span.
void net_of(const BSplineSurface& s, const Rectangle& where, const Vec3& origin, Net& net) {
  const Vec2 middle = where.middle();
  const int span_u = find_span(s.degree_u, s.knots_u, middle.x());
  const int span_v = find_span(s.degree_v, s.knots_v, middle.y());
  const BezierMatrix& u = bezier_matrix(s.knots_u, s.degree_u, span_u, where.low.x(), where.high.x(), true);
  const BezierMatrix& v = bezier_matrix(s.knots_v, s.degree_v, span_v, where.low.y(), where.high.y(), false);
  Net poles, half;
  poles_at(s, span_u, span_v, origin, poles);
  half.rows = net.rows = poles.rows;
  half.columns = net.columns = poles.columns;
  for (int i = 0; i < net.rows; ++i) {
    for (int j = 0; j < net.columns; ++j) {
      Eigen::Vector4d sum = u(i, 0) * poles.at(0, j);
      for (int a = 1; a < net.rows; ++a) sum += u(i, a) * poles.at(a, j);
      half.at(i, j) = sum;
    }
    for (int j = 0; j < net.columns; ++j) {
      Eigen::Vector4d sum = v(j, 0) * half.at(i, 0);
      for (int a = 1; a < net.columns; ++a) sum += v(j, a) * half.at(i, a);
      net.at(i, j) = sum;
    }
  }
}

/// Largest norms of a net's control points, of points and weights.
struct Norms {
  double point = 0.0, weight = 0.0;
};
Norms norms(const Net& net) {
  Norms n;
  for (const Eigen::Vector4d& p : net.all()) {
    n.point = std::max(n.point, p.head<3>().squaredNorm());
    n.weight = std::max(n.weight, std::abs(p.w()));
  }
  n.point = std::sqrt(n.point);
  return n;
}

/// The net of the derivative in one direction.
void derive(const Net& net, bool along_u, Net& out) {
  out.rows = std::max(0, net.rows - (along_u ? 1 : 0));
  out.columns = std::max(0, net.columns - (along_u ? 0 : 1));
  const double degree = along_u ? out.rows : out.columns;
  for (int i = 0; i < out.rows; ++i)
    for (int j = 0; j < out.columns; ++j)
      out.at(i, j) = degree * (net.at(along_u ? i + 1 : i, along_u ? j : j + 1) - net.at(i, j));
}

}  // namespace

bool one_piece(const BSplineSurface& s, const Rectangle& where) {
  const auto whole = [](int degree, const std::vector<double>& knots, double low, double high) {
    const auto span = static_cast<std::size_t>(find_span(degree, knots, 0.5 * (low + high)));
    return (low >= knots[span] || span == static_cast<std::size_t>(degree)) &&
           (high <= knots[span + 1] || span + static_cast<std::size_t>(degree) + 2 >= knots.size());
  };
  return whole(s.degree_u, s.knots_u, where.low.x(), where.high.x()) &&
         whole(s.degree_v, s.knots_v, where.low.y(), where.high.y());
}

// S = A / w, so w S_u = A_u - w_u S and so on; with the middle as origin |S| is at most `reach`. The control points of a
// derivative hold the derivative.
PatchBounds patch_bounds(const BSplineSurface& s, const Rectangle& where) {
  PatchBounds out;
  out.middle = s.value(where.middle().x(), where.middle().y());
  Net net, first, second;
  net_of(s, where, out.middle, net);
  const double least = net.least_weight();
  if (!(least > 0.0)) {
    out.reach = out.du = out.dv = out.duu = out.duv = out.dvv = kInfinite;
    return out;
  }
  for (const Eigen::Vector4d& p : net.all()) out.reach = std::max(out.reach, p.head<3>().norm() / p.w());
  const auto second_norms = [&](bool along_u) {
    derive(first, along_u, second);
    return norms(second);
  };
  derive(net, true, first);
  const Norms u = norms(first), uu = second_norms(true), uv = second_norms(false);
  derive(net, false, first);
  const Norms v = norms(first), vv = second_norms(false);
  const double e = out.reach;
  out.du = (u.point + u.weight * e) / least;
  out.dv = (v.point + v.weight * e) / least;
  out.duu = (uu.point + 2.0 * u.weight * out.du + uu.weight * e) / least;
  out.duv = (uv.point + u.weight * out.dv + v.weight * out.du + uv.weight * e) / least;
  out.dvv = (vv.point + 2.0 * v.weight * out.dv + vv.weight * e) / least;
  return out;
}

bool add_control_points(const BSplineSurface& s, const Rectangle& where, std::vector<Vec3>& points) {
  const Vec3& origin = s.pole(0, 0);
  Net net;
  net_of(s, where, origin, net);
  if (!(net.least_weight() > 0.0)) return false;
  for (const Eigen::Vector4d& p : net.all()) points.emplace_back(origin + p.head<3>() / p.w());
  return true;
}

PatchBounds loose_bounds(const BSplineSurface& s, const Rectangle& where) {
  PatchBounds out;
  const int first_u = find_span(s.degree_u, s.knots_u, where.low.x()) - s.degree_u;
  const int first_v = find_span(s.degree_v, s.knots_v, where.low.y()) - s.degree_v;
  const int last_u = find_span(s.degree_u, s.knots_u, where.high.x());
  const int last_v = find_span(s.degree_v, s.knots_v, where.high.y());
  Box3 box;
  for (int i = first_u; i <= last_u; ++i)
    for (int j = first_v; j <= last_v; ++j) box.add(s.pole(i, j));
  out.middle = box.center();
  out.reach = 0.5 * box.diagonal() * (1.0 + 1e-12);
  if (!s.weights.empty() && !(*std::min_element(s.weights.begin(), s.weights.end()) > 0.0)) out.reach = kInfinite;
  out.du = out.dv = out.duu = out.duv = out.dvv = kInfinite;
  return out;
}

CurveBounds curve_bounds(const BSplineCurve2& curve, double low, double high) {
  const int span = find_span(curve.degree, curve.knots, 0.5 * (low + high));
  const BezierMatrix& m = bezier_matrix(curve.knots, curve.degree, span, low, high, true);
  const int width = curve.degree + 1;
  const Vec2 origin = curve.value(0.5 * (low + high));
  Eigen::Matrix<double, Eigen::Dynamic, 3, 0, kWidth, 3> net(width, 3);
  net.setZero();
  for (int j = 0; j < width; ++j) {
    const int at = span - curve.degree + j;
    const double w = curve.weights.empty() ? 1.0 : curve.weights[static_cast<std::size_t>(at)];
    const Vec2 p = w * (curve.poles.col(at) - origin);
    for (int i = 0; i < width; ++i) net.row(i) += m(i, j) * Eigen::RowVector3d(p.x(), p.y(), w);
  }
  CurveBounds out;
  Vec2 least = Vec2::Zero(), most = Vec2::Zero(), far = Vec2::Zero();
  const double weight = net.col(2).minCoeff();
  if (!(weight > 0.0)) {
    out.box = {Vec2::Constant(-kInfinite), Vec2::Constant(kInfinite)};
    out.d1 = out.d2 = Vec2::Constant(kInfinite);
    return out;
  }
  for (int j = 0; j < width; ++j) {
    const Vec2 p = net.row(j).head<2>().transpose() / net(j, 2);
    least = least.cwiseMin(p), most = most.cwiseMax(p), far = far.cwiseMax(p.cwiseAbs());
  }
  out.box = {origin + least, origin + most};
  Eigen::Vector3d first = Eigen::Vector3d::Zero(), second = Eigen::Vector3d::Zero();
  const double degree = curve.degree;
  for (int j = 0; j + 1 < width; ++j)
    first = first.cwiseMax(degree * (net.row(j + 1) - net.row(j)).cwiseAbs().transpose());
  for (int j = 0; j + 2 < width; ++j)
    second = second.cwiseMax(degree * (degree - 1.0) *
                             (net.row(j + 2) - 2.0 * net.row(j + 1) + net.row(j)).cwiseAbs().transpose());
  out.d1 = (first.head<2>() + first.z() * far) / weight;
  out.d2 = (second.head<2>() + 2.0 * first.z() * out.d1 + second.z() * far) / weight;
  return out;
}

}  // namespace flank::internal::verify
