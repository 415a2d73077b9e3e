#include "paper_a.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <map>
#include <numbers>

#include "flank/base/random.h"

namespace flank::internal::bench {
namespace {

// CPU time: see fit_scenes.h.
double now() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

std::vector<std::uint8_t> find_border_edges(const TriangleMesh& mesh) {
  std::map<std::pair<int, int>, int> uses;
  const auto key = [](int i, int j) { return std::make_pair(std::min(i, j), std::max(i, j)); };
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++uses[key(t[(k + 1) % 3], t[(k + 2) % 3])];
  std::vector<std::uint8_t> border;
  for (const auto& t : mesh.triangles) {
    unsigned bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      if (uses[key(t[(k + 1) % 3], t[(k + 2) % 3])] == 1) bits |= 1u << k;
    border.push_back(static_cast<std::uint8_t>(bits));
  }
  return border;
}

// Values of the four cubic basis functions that act at t.
struct Basis {
  int first = 0;
  std::array<double, 4> n{};
};

Basis basis_at(const std::vector<double>& knots, double t) {
  Basis basis;
  const int span = find_span(3, knots, t);
  basis_derivatives(3, knots, span, t, 0, basis.n.data());
  basis.first = span - 3;
  return basis;
}

}  // namespace

PaperA::PaperA(const TriangleMesh& mesh, const PaperAOptions& options)
    : options_(options), tree_(mesh), border_edges_(find_border_edges(mesh)) {
  for (int j = 0; j < options.samples_s; ++j) s_.push_back(static_cast<double>(j) / (options.samples_s - 1));
}

PaperA::Foot PaperA::foot(const Vec3& p) const {
  const BvhHit hit = tree_.closest(p);
  Foot foot;
  foot.point = hit.point;
  const Vec3 r = p - hit.point;
  foot.distance = r.norm();
  foot.normal = r / foot.distance;
  const std::array<double, 3> weights{1.0 - hit.u - hit.v, hit.u, hit.v};
  for (std::size_t k = 0; k < 3; ++k) {
    const bool edge = (border_edges_[static_cast<std::size_t>(hit.triangle)] >> k & 1) != 0;
    foot.border = foot.border || (edge && weights[k] < 1e-9);
  }
  return foot;
}

// (4) to (6): the generalised eigenproblem of the five parameters (v_a, lambda_1, lambda_2) with |v_m| = 1.
PaperA::Velocity PaperA::movability(const Line& line, const Vec3& previous) const {
  const Vec3 u = (line.b - line.a).normalized(), n1 = u.unitOrthogonal(), n2 = u.cross(n1);
  Eigen::Matrix<double, 5, 5> form = Eigen::Matrix<double, 5, 5>::Zero();
  bool off = true;
  for (const double s : s_) {
    const Foot f = foot((1.0 - s) * line.a + s * line.b);
    Eigen::Matrix<double, 5, 1> row;
    row << f.normal, s * f.normal.dot(n1), s * f.normal.dot(n2);
    form += row * row.transpose() / static_cast<double>(s_.size());
    off = off && f.border;
  }
  form.diagonal().array() += 1e-12;
  Eigen::Matrix<double, 3, 5> middle =
      Eigen::Matrix<double, 3, 5>::Zero();  // v_m = v_a + (lambda_1 n1 + lambda_2 n2) / 2
  middle.leftCols<3>().setIdentity();
  middle.col(3) = 0.5 * n1;
  middle.col(4) = 0.5 * n2;
  const Eigen::Matrix<double, 5, 5> constraint = middle.transpose() * middle;
  // Largest nu of B x = nu A x is the smallest lambda = 1 / nu of A x = lambda B x.
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix<double, 5, 5>> eigen(constraint, form);
  Eigen::Matrix<double, 5, 1> x = eigen.eigenvectors().col(4);
  const Vec3 v = middle * x;
  x *= (v.dot(previous) < 0.0 ? -1.0 : 1.0) / v.norm();
  const Vec3 va = x.head<3>();
  return {va, va + x[3] * n1 + x[4] * n2, x.dot(form * x), off};
}

// 4.2: random points in the normal planes of both ends, all pairs, the best is kept.
PaperA::Line PaperA::sample(const Line& start) const {
  Random random(options_.seed);
  Line best = start;
  double least = movability(best, Vec3::Zero()).value;
  const double length = (start.b - start.a).norm();
  for (int round = 0; round < options_.sampling_rounds; ++round) {
    const Vec3 u = (best.b - best.a).normalized(), n1 = u.unitOrthogonal(), n2 = u.cross(n1);
    const auto around = [&](const Vec3& p) {
      std::vector<Vec3> points;
      for (int k = 0; k < options_.end_samples; ++k) {
        const double r = options_.sampling_radius * std::sqrt(random.uniform());
        const double angle = 2.0 * std::numbers::pi * random.uniform();
        points.push_back(p + r * (std::cos(angle) * n1 + std::sin(angle) * n2));
      }
      return points;
    };
    const std::vector<Vec3> tips = around(best.a), ends = around(best.b);
    for (const Vec3& a : tips)
      for (const Vec3& b : ends) {
        const Vec3 half = 0.5 * length * (b - a).normalized(), m = 0.5 * (a + b);
        const Line line{m - half, m + half};
        const double value = movability(line, Vec3::Zero()).value;
        if (value >= least) continue;
        least = value;
        best = line;
      }
  }
  return best;
}

// 4.3: Euler steps of the best tangential velocity until the border or the threshold.
std::vector<PaperA::Line> PaperA::propagate(const Line& start, const Vec3& heading) const {
  std::vector<Line> lines{start};
  const double length = (start.b - start.a).norm();
  Vec3 previous = heading;
  const int most = static_cast<int>(4.0 / options_.euler_step);
  while (static_cast<int>(lines.size()) < most) {
    const Line& line = lines.back();
    const Velocity v = movability(line, previous);
    if (v.off || v.value > options_.movability_limit) break;
    previous = 0.5 * (v.a + v.b);
    const Vec3 a = line.a + options_.euler_step * v.a, b = line.b + options_.euler_step * v.b;
    const Vec3 half = 0.5 * length * (b - a).normalized(), m = 0.5 * (a + b);
    lines.push_back({m - half, m + half});
  }
  return lines;
}

PaperAResult PaperA::run(const Vec3& tip, const Vec3& holder) const {
  const double begin = now();
  const Line start = sample({tip, holder});
  const Velocity v = movability(start, Vec3::Zero());
  const Vec3 heading = 0.5 * (v.a + v.b);
  std::vector<Line> lines = propagate(start, -heading);
  std::reverse(lines.begin(), lines.end());
  const std::vector<Line> forward = propagate(start, heading);
  lines.insert(lines.end(), forward.begin() + 1, forward.end());
  PaperAResult result;
  result.euler_steps = static_cast<int>(lines.size()) - 1;
  result.axis_length = (holder - tip).norm();
  if (result.euler_steps < options_.control_points) return result;
  Eigen::Matrix3Xd a(3, lines.size()), b(3, lines.size());
  std::vector<double> t;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    a.col(static_cast<Eigen::Index>(k)) = lines[k].a;
    b.col(static_cast<Eigen::Index>(k)) = lines[k].b;
    t.push_back(static_cast<double>(k) / static_cast<double>(lines.size() - 1));
  }
  result.a = fit_curve(a, t, 3, options_.control_points);
  result.b = fit_curve(b, t, 3, options_.control_points);
  result.d = initial_distances(result);
  result.init_seconds = now() - begin;
  optimise(result);
  return result;
}

PaperAResult PaperA::run(const BSplineCurve3& a, const BSplineCurve3& b, double axis_length) const {
  const double begin = now();
  PaperAResult result;
  result.a = a;
  result.b = b;
  result.axis_length = axis_length;
  result.d = initial_distances(result);
  result.init_seconds = now() - begin;
  optimise(result);
  return result;
}

// "Meridian update": a cubic spline with ten control points through all footpoints in a common plane, then the
// distances of the axis samples to it.
Eigen::VectorXd PaperA::initial_distances(const PaperAResult& state) const {
  std::vector<Vec3> plane;
  double low = 1e300, high = -1e300;
  for (int i = 0; i < options_.samples_t; ++i) {
    const double t = static_cast<double>(i) / (options_.samples_t - 1);
    const Vec3 a = state.a.value(t), u = (state.b.value(t) - a).normalized();
    for (const double s : s_) {
      const Foot f = foot(a + s * state.axis_length * u);
      if (f.border) continue;
      const double z = u.dot(f.point - a);
      plane.emplace_back(z, (f.point - a - z * u).norm(), 0.0);
      low = std::min(low, z);
      high = std::max(high, z);
    }
  }
  Eigen::Matrix3Xd points(3, plane.size());
  std::vector<double> parameters;
  for (std::size_t k = 0; k < plane.size(); ++k) {
    points.col(static_cast<Eigen::Index>(k)) = plane[k];
    parameters.push_back((plane[k].x() - low) / (high - low));
  }
  const BSplineCurve3 meridian = fit_curve(points, parameters, 3, 10);
  Eigen::VectorXd d(s_.size());
  for (std::size_t j = 0; j < s_.size(); ++j) {
    double least = 1e300;
    for (int k = 0; k <= 400; ++k)
      least = std::min(least, (meridian.value(k / 400.0) - Vec3(s_[j] * state.axis_length, 0.0, 0.0)).norm());
    d[static_cast<Eigen::Index>(j)] = least;
  }
  return d;
}

// (8) to (12) by Gauss-Newton, all unknowns at once: control points of a, of b, distances d_j.
void PaperA::optimise(PaperAResult& state) const {
  const double begin = now();
  const int m = options_.samples_t, n = options_.samples_s, count = state.a.count(), d0 = 6 * count, size = d0 + n;
  std::vector<Basis> basis;
  for (int i = 0; i < m; ++i) basis.push_back(basis_at(state.a.knots, static_cast<double>(i) / (m - 1)));
  Eigen::MatrixXd fair = Eigen::MatrixXd::Zero(count, count);  // of (11), the same for a and b and for x, y, z
  for (int i = 1; i + 1 < m; ++i) {
    Eigen::VectorXd row = Eigen::VectorXd::Zero(count);
    for (int k = -1; k <= 1; ++k) {
      const Basis& at = basis[static_cast<std::size_t>(i + k)];
      for (int l = 0; l < 4; ++l) row[at.first + l] += (k == 0 ? -2.0 : 1.0) * at.n[static_cast<std::size_t>(l)];
    }
    fair += options_.mu2 / m * row * row.transpose();
  }
  Eigen::MatrixXd h(size, size);
  Eigen::VectorXd g(size);
  double before = 1e300;
  for (int iteration = 0; iteration <= options_.iterations; ++iteration) {
    h.setZero();
    g.setZero();
    double objective = 0.0, squares = 0.0;
    const double w1 = options_.mu1 / (m * n), w3 = options_.mu3 / (m * n), w4 = options_.mu4 / m;
    for (int i = 0; i < m; ++i) {
      const Basis& at = basis[static_cast<std::size_t>(i)];
      const Vec3 a = state.a.value(static_cast<double>(i) / (m - 1)),
                 b = state.b.value(static_cast<double>(i) / (m - 1));
      std::array<int, 8> column;  // first of three unknowns of each control point that acts
      for (int k = 0; k < 4; ++k) {
        column[static_cast<std::size_t>(k)] = 3 * (at.first + k);
        column[static_cast<std::size_t>(k + 4)] = 3 * (count + at.first + k);
      }
      for (int j = 0; j < n; ++j) {
        const double s = s_[static_cast<std::size_t>(j)];
        const Vec3 p = (1.0 - s) * a + s * b;
        const Foot f = foot(p);
        const double e = (p - f.point).dot(f.normal) - state.d[j];
        const Vec3 e3 = p - f.point - state.d[j] * f.normal;
        objective += w1 * e * e + w3 * e3.squaredNorm();
        squares += e * e;
        const Eigen::Matrix3d block = w1 * f.normal * f.normal.transpose() + w3 * Eigen::Matrix3d::Identity();
        const Vec3 gradient = w1 * e * f.normal + w3 * e3;
        std::array<double, 8> c;
        for (std::size_t k = 0; k < 4; ++k) {
          c[k] = (1.0 - s) * at.n[k];
          c[k + 4] = s * at.n[k];
        }
        for (std::size_t k = 0; k < 8; ++k) {
          for (std::size_t l = 0; l <= k; ++l) h.block<3, 3>(column[k], column[l]) += c[k] * c[l] * block;
          h.block<1, 3>(d0 + j, column[k]) -= c[k] * (w1 + w3) * f.normal.transpose();
          g.segment<3>(column[k]) += c[k] * gradient;
        }
        h(d0 + j, d0 + j) += w1 + w3;
        g[d0 + j] -= w1 * e + w3 * f.normal.dot(e3);
      }
      const Vec3 r = a - b;
      const double e4 = r.squaredNorm() - state.axis_length * state.axis_length;
      objective += w4 * e4 * e4;
      for (std::size_t k = 0; k < 8; ++k) {
        const double ck = (k < 4 ? 1.0 : -1.0) * at.n[k % 4];
        for (std::size_t l = 0; l <= k; ++l) {
          const double cl = (l < 4 ? 1.0 : -1.0) * at.n[l % 4];
          h.block<3, 3>(column[k], column[l]) += 4.0 * w4 * ck * cl * r * r.transpose();
        }
        g.segment<3>(column[k]) += 2.0 * w4 * e4 * ck * r;
      }
    }
    for (int rail = 0; rail < 2; ++rail) {
      const BSplineCurve3& curve = rail == 0 ? state.a : state.b;
      const Eigen::Matrix3Xd pull = curve.poles * fair;
      objective += pull.cwiseProduct(curve.poles).sum();
      for (int k = 0; k < count; ++k) {
        g.segment<3>(3 * (rail * count + k)) += pull.col(k);
        for (int l = 0; l <= k; ++l)
          h.block<3, 3>(3 * (rail * count + k), 3 * (rail * count + l)).diagonal().array() += fair(k, l);
      }
    }
    state.trace.push_back({objective, std::sqrt(squares / (m * n)), now() - begin});
    if (iteration == options_.iterations || std::abs(before - objective) < options_.stop * before) break;
    before = objective;
    const Eigen::VectorXd x = h.selfadjointView<Eigen::Lower>().ldlt().solve(-g);
    for (int k = 0; k < count; ++k) {
      state.a.poles.col(k) += x.segment<3>(3 * k);
      state.b.poles.col(k) += x.segment<3>(3 * (count + k));
    }
    state.d += x.tail(n);
  }
  state.optimise_seconds = now() - begin;
}

}  // namespace flank::internal::bench
