#include "flank/verify/proof/patch_bounds.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace flank::internal::verify {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr int kWidth = kMaxDegree + 1;

/// Row i: how the i-th Bezier control point over [low, high] is made of the degree + 1 control points that act on the
/// span. Millions are asked for: no memory is taken, and none is filled that is not used.
struct BezierMatrix {
  int width = 0;
  std::array<double, kWidth * kWidth> at;  // NOLINT(*-member-init): of `width` rows, as long

  [[nodiscard]] double operator()(int i, int j) const { return at[static_cast<std::size_t>(i * width + j)]; }
  [[nodiscard]] double* row(int i) { return at.data() + static_cast<std::ptrdiff_t>(i) * width; }
};

/// A level of de Boor's recursion at t, for rows that say how each value is made of the control points.
void de_boor_level(const std::vector<double>& knots, int degree, int span, int level, double t, BezierMatrix& rows) {
  for (int j = degree; j >= level; --j) {
    const auto k = static_cast<std::size_t>(span - degree + j);
    const double alpha = (t - knots[k]) / (knots[k + static_cast<std::size_t>(degree - level + 1)] - knots[k]);
    const double* before = rows.row(j - 1);
    double* row = rows.row(j);
    // Row j holds no more than the control points j - level to j.
    for (int c = j - level; c <= j; ++c) row[c] = (1.0 - alpha) * before[c] + alpha * row[c];
  }
}

/// By the blossom: de Boor's recursion at `low` in its first levels and at `high` in the others. The levels at `low` are common
/// to all.
BezierMatrix bezier_matrix(const std::vector<double>& knots, int degree, int span, double low, double high) {
  BezierMatrix out, common;
  const int width = degree + 1;
  out.width = common.width = width;
  const auto used = static_cast<std::ptrdiff_t>(width) * width;
  std::fill_n(common.at.begin(), used, 0.0);
  for (int i = 0; i < width; ++i) common.row(i)[i] = 1.0;
  for (int i = degree; i >= 0; --i) {
    BezierMatrix rows;
    rows.width = width;
    std::copy_n(common.at.begin(), used, rows.at.begin());
    for (int level = degree - i + 1; level <= degree; ++level) de_boor_level(knots, degree, span, level, high, rows);
    std::copy_n(rows.row(degree), width, out.row(i));
    if (i > 0) de_boor_level(knots, degree, span, degree - i + 1, low, common);
  }
  return out;
}

/// A Bezier net in homogeneous coordinates, its points relative to an origin: w (P - origin), and w.
struct Net {
  int rows = 0, columns = 0;
  std::array<std::array<double, kWidth * kWidth>, 4> c;  // NOLINT(*-member-init): of `rows` rows, `columns` long

  [[nodiscard]] std::size_t index(int i, int j) const { return static_cast<std::size_t>(i * columns + j); }
  [[nodiscard]] Vec3 point(int i, int j) const {
    const std::size_t k = index(i, j);
    return {c[0][k], c[1][k], c[2][k]};
  }
  [[nodiscard]] double weight(int i, int j) const { return c[3][index(i, j)]; }
  [[nodiscard]] double least_weight() const {
    return *std::min_element(c[3].begin(), c[3].begin() + static_cast<std::ptrdiff_t>(rows) * columns);
  }
};

/// The control points that act at a place, relative to an origin.
Net poles_at(const BSplineSurface& s, int span_u, int span_v, const Vec3& origin) {
  Net poles;
  poles.rows = s.degree_u + 1;
  poles.columns = s.degree_v + 1;
  for (int i = 0; i < poles.rows; ++i) {
    for (int j = 0; j < poles.columns; ++j) {
      const int at_u = span_u - s.degree_u + i, at_v = span_v - s.degree_v + j;
      const double w = s.weights.empty() ? 1.0 : s.weights[static_cast<std::size_t>(at_u * s.count_v + at_v)];
      const Vec3 p = w * (s.pole(at_u, at_v) - origin);
      const std::size_t at = poles.index(i, j);
      for (int k = 0; k < 3; ++k) poles.c[static_cast<std::size_t>(k)][at] = p[k];
      poles.c[3][at] = w;
    }
  }
  return poles;
}

Net net_of(const BSplineSurface& s, const Rectangle& where, const Vec3& origin) {
  const Vec2 middle = where.middle();
  const int span_u = find_span(s.degree_u, s.knots_u, middle.x());
  const int span_v = find_span(s.degree_v, s.knots_v, middle.y());
  const Net poles = poles_at(s, span_u, span_v, origin);
  const BezierMatrix u = bezier_matrix(s.knots_u, s.degree_u, span_u, where.low.x(), where.high.x());
  const BezierMatrix v = bezier_matrix(s.knots_v, s.degree_v, span_v, where.low.y(), where.high.y());
  Net net;
  net.rows = poles.rows;
  net.columns = poles.columns;
  const std::size_t coordinates = s.weights.empty() ? 3 : 4;
  std::array<double, kWidth> row;  // NOLINT(*-member-init)
  for (std::size_t k = 0; k < coordinates; ++k) {
    for (int i = 0; i < net.rows; ++i) {
      for (int j = 0; j < net.columns; ++j) {
        double sum = 0.0;
        for (int a = 0; a < net.rows; ++a) sum += u(i, a) * poles.c[k][poles.index(a, j)];
        row[static_cast<std::size_t>(j)] = sum;
      }
      for (int j = 0; j < net.columns; ++j) {
        double sum = 0.0;
        for (int a = 0; a < net.columns; ++a) sum += v(j, a) * row[static_cast<std::size_t>(a)];
        net.c[k][net.index(i, j)] = sum;
      }
    }
  }
  if (s.weights.empty()) std::fill_n(net.c[3].begin(), net.rows * net.columns, 1.0);
  return net;
}

/// Largest norms of a net's control points, of points and weights.
struct Norms {
  double point = 0.0, weight = 0.0;
};
Norms norms(const Net& net) {
  Norms n;
  for (int i = 0; i < net.rows; ++i) {
    for (int j = 0; j < net.columns; ++j) {
      n.point = std::max(n.point, net.point(i, j).squaredNorm());
      n.weight = std::max(n.weight, std::abs(net.weight(i, j)));
    }
  }
  n.point = std::sqrt(n.point);
  return n;
}

/// The net of the derivative in one direction.
Net derived(const Net& net, bool along_u) {
  Net out;
  out.rows = std::max(0, net.rows - (along_u ? 1 : 0));
  out.columns = std::max(0, net.columns - (along_u ? 0 : 1));
  const double degree = along_u ? out.rows : out.columns;
  for (std::size_t k = 0; k < 4; ++k)
    for (int i = 0; i < out.rows; ++i)
      for (int j = 0; j < out.columns; ++j)
        out.c[k][out.index(i, j)] =
            degree * (net.c[k][net.index(along_u ? i + 1 : i, along_u ? j : j + 1)] - net.c[k][net.index(i, j)]);
  return out;
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
  const Net net = net_of(s, where, out.middle);
  const double least = net.least_weight();
  if (!(least > 0.0)) {
    out.reach = out.du = out.dv = out.duu = out.duv = out.dvv = kInfinite;
    return out;
  }
  for (int i = 0; i < net.rows; ++i)
    for (int j = 0; j < net.columns; ++j) out.reach = std::max(out.reach, net.point(i, j).norm() / net.weight(i, j));
  const Net net_u = derived(net, true), net_v = derived(net, false);
  const Norms u = norms(net_u), v = norms(net_v);
  const Norms uu = norms(derived(net_u, true)), uv = norms(derived(net_u, false)), vv = norms(derived(net_v, false));
  const double e = out.reach;
  out.du = (u.point + u.weight * e) / least;
  out.dv = (v.point + v.weight * e) / least;
  out.duu = (uu.point + 2.0 * u.weight * out.du + uu.weight * e) / least;
  out.duv = (uv.point + u.weight * out.dv + v.weight * out.du + uv.weight * e) / least;
  out.dvv = (vv.point + 2.0 * v.weight * out.dv + vv.weight * e) / least;
  return out;
}

void control_points(const BSplineSurface& s, const Rectangle& where, std::vector<Vec3>& points) {
  points.clear();
  const Vec3 origin = s.pole(0, 0);
  const Net net = net_of(s, where, origin);
  if (!(net.least_weight() > 0.0)) return;
  for (int i = 0; i < net.rows; ++i)
    for (int j = 0; j < net.columns; ++j) points.emplace_back(origin + net.point(i, j) / net.weight(i, j));
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
  const BezierMatrix m = bezier_matrix(curve.knots, curve.degree, span, low, high);
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
