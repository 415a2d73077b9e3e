#include "flank/correct/motion/aimed_motion.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "flank/base/parallel.h"
#include "flank/bspline_basis.h"
#include "flank/envelope/swept_estimate.h"

namespace flank::internal {
namespace {

constexpr int kPointsPerSide = 50;
constexpr double kUnfinished = 4.0;  ///< tolerances: what more is left is not what the tool's motion says
constexpr int kPosesPerPoint = 4;    ///< of the table that finds contacts, for each control point of a rail
constexpr int kDegree = 3, kChangePoints = 16;
constexpr int kUnknowns = 6 * kChangePoints;  ///< of a motion: tip, and direction times axis length
constexpr int kSteps = 6;
/// Shares of the mean diagonal of the normal equations: of second differences of the change, and of the change itself, which hold what
/// the face leaves open, as the slide of a tool along itself.
constexpr double kFair = 1e-3, kStill = 1e-7;

/// A point of the face and what is to be left there.
struct Aim {
  Vec3 point = Vec3::Zero();
  double wanted_mm = 0.0, area = 0.0;
};

SweptEstimate swept_by(const std::vector<RuledMotion>& motions, const RadialFunction& tool) {
  return {motions, tool, kPosesPerPoint * motions.front().tip.count()};
}

std::vector<SweptContact> contacts(const std::vector<Aim>& aims, const std::vector<RuledMotion>& motions,
                                   const RadialFunction& tool) {
  const SweptEstimate swept = swept_by(motions, tool);
  std::vector<SweptContact> all(aims.size());
  parallel_for(aims.size(), [&](std::size_t k) { all[k] = swept.refine(aims[k].point, swept.nearest(aims[k].point)); });
  return all;
}

/// Points all over the face and on its border, but for those that the old motions leave unfinished.
std::vector<Aim> aims_of(const AimProblem& problem) {
  const double spacing = std::sqrt(problem.target->area()) / kPointsPerSide;
  std::vector<Aim> all;
  for (const SurfaceSample& sample : problem.target->samples(spacing)) all.push_back({sample.point, 0.0, sample.area});
  for (const Vec3& p : problem.target->border_points(spacing)) all.push_back({p, 0.0, 0.5 * spacing * spacing});
  const std::vector<SweptContact> old = contacts(all, problem.motions, problem.tool);
  parallel_for(all.size(), [&](std::size_t k) { all[k].wanted_mm = old[k].f - problem.less_mm(all[k].point); });
  std::vector<Aim> aims;
  for (std::size_t k = 0; k < all.size(); ++k)
    if (old[k].f <= kUnfinished * problem.tolerance_mm) aims.push_back(all[k]);
  return aims;
}

/// Weighted mean square of what is off; infinite where a motion has lost its values.
double cost_of(const std::vector<Aim>& aims, const std::vector<SweptContact>& at) {
  double squares = 0.0, areas = 0.0;
  for (std::size_t k = 0; k < aims.size(); ++k) {
    squares += aims[k].area * std::pow(at[k].f - aims[k].wanted_mm, 2);
    areas += aims[k].area;
  }
  const double cost = areas > 0.0 ? squares / areas : 0.0;
  return std::isfinite(cost) ? cost : 1e300;
}

/// The control points of the change that a contact depends on, and by how much f grows with each of their numbers.
struct Row {
  int first = 0;
  Eigen::Matrix<double, 6 * (kDegree + 1), 1> slopes = Eigen::Matrix<double, 6 * (kDegree + 1), 1>::Zero();
};

/// The derivative of f is that of the sphere at the contact.
Row row_of(const SweptContact& contact, const RuledMotion& motion, const std::vector<double>& knots) {
  Row row;
  const int span = find_span(kDegree, knots, contact.t);
  std::array<double, kMaxDegree + 1> basis{};
  basis_derivatives(kDegree, knots, span, contact.t, 0, basis.data());
  const Vec3 w = motion.direction.value(contact.t), u = w.normalized(), n = contact.to_axis;
  Eigen::Matrix<double, 6, 1> pose;
  pose << n, (contact.s / (motion.axis_length * w.norm())) * (n - n.dot(u) * u);
  row.first = span - kDegree;
  for (int j = 0; j <= kDegree; ++j) row.slopes.segment<6>(6 * j) = basis[static_cast<std::size_t>(j)] * pose;
  return row;
}

/// Second differences of the change, and the change itself, as shares of the mean diagonal.
void add_smoothing(Eigen::MatrixXd& normal) {
  const double unit = normal.trace() / static_cast<double>(normal.rows());
  for (Eigen::Index at = 0; at < normal.rows(); at += kUnknowns)
    for (Eigen::Index k = 0; k + 2 < kChangePoints; ++k)
      for (Eigen::Index i = 0; i < 6; ++i) {
        const std::array<double, 3> second{1.0, -2.0, 1.0};
        for (Eigen::Index a = 0; a < 3; ++a)
          for (Eigen::Index b = 0; b < 3; ++b)
            normal(at + 6 * (k + a) + i, at + 6 * (k + b) + i) +=
                kFair * unit * second[static_cast<std::size_t>(a)] * second[static_cast<std::size_t>(b)];
      }
  normal.diagonal().array() += kStill * unit;
}

/// A Gauss-Newton step of the change from these contacts.
Eigen::VectorXd step_from(const std::vector<Aim>& aims, const std::vector<SweptContact>& at,
                          const std::vector<RuledMotion>& motions, const std::vector<double>& knots) {
  const auto size = static_cast<Eigen::Index>(motions.size()) * kUnknowns;
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(size, size);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(size);
  for (std::size_t k = 0; k < aims.size(); ++k) {
    if (at[k].motion < 0 || !std::isfinite(at[k].f)) continue;
    const Row row = row_of(at[k], motions[static_cast<std::size_t>(at[k].motion)], knots);
    const Eigen::Index first = at[k].motion * kUnknowns + 6 * row.first;
    constexpr Eigen::Index kActive = 6 * (kDegree + 1);
    normal.block<kActive, kActive>(first, first) += aims[k].area * row.slopes * row.slopes.transpose();
    right.segment<kActive>(first) -= aims[k].area * (at[k].f - aims[k].wanted_mm) * row.slopes;
  }
  add_smoothing(normal);
  return normal.ldlt().solve(right);
}

/// Motions with a change added to their rails.
std::vector<RuledMotion> changed(const std::vector<RuledMotion>& motions, const Eigen::VectorXd& step,
                                 const std::vector<double>& knots) {
  constexpr int kPerPoint = 4;
  std::vector<RuledMotion> next = motions;
  for (std::size_t m = 0; m < next.size(); ++m) {
    BSplineCurve3 tip, direction;
    tip.degree = direction.degree = kDegree;
    tip.knots = direction.knots = knots;
    tip.poles.resize(3, kChangePoints);
    direction.poles.resize(3, kChangePoints);
    for (Eigen::Index k = 0; k < kChangePoints; ++k) {
      const Eigen::Index at = static_cast<Eigen::Index>(m) * kUnknowns + 6 * k;
      tip.poles.col(k) = step.segment<3>(at);
      direction.poles.col(k) = step.segment<3>(at + 3) / next[m].axis_length;
    }
    const int count = next[m].tip.count(), places = kPerPoint * count;
    Eigen::Matrix3Xd tips(3, places), directions(3, places);
    std::vector<double> t;
    for (int i = 0; i < places; ++i) {
      t.push_back(static_cast<double>(i) / (places - 1));
      tips.col(i) = tip.value(t.back());
      directions.col(i) = direction.value(t.back());
    }
    next[m].tip.poles += fit_curve(tips, t, kDegree, count).poles;
    next[m].direction.poles += fit_curve(directions, t, kDegree, count).poles;
  }
  return next;
}

}  // namespace

AimedMotions aimed_motions(const AimProblem& problem) {
  const std::vector<Aim> aims = aims_of(problem);
  const std::vector<double> knots = uniform_knots(kDegree, kChangePoints);
  AimedMotions out{problem.motions, 0.0, 0.0};
  std::vector<SweptContact> at = contacts(aims, out.motions, problem.tool);
  double cost = cost_of(aims, at);
  for (int k = 0; k < kSteps; ++k) {
    constexpr double kSettled = 0.999;  // of the cost
    std::vector<RuledMotion> next = changed(out.motions, step_from(aims, at, out.motions, knots), knots);
    std::vector<SweptContact> there = contacts(aims, next, problem.tool);
    const double less = cost_of(aims, there);
    if (!(less < cost)) break;
    const bool settled = less > kSettled * cost;
    out.motions = std::move(next);
    at = std::move(there);
    cost = less;
    if (settled) break;
  }
  out.rms_mm = std::sqrt(cost);
  for (std::size_t k = 0; k < aims.size(); ++k)
    out.largest_mm = std::max(out.largest_mm, std::abs(at[k].f - aims[k].wanted_mm));
  return out;
}

}  // namespace flank::internal
