#include "flank/correct/motion/aimed_motion.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

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
constexpr int kSteps = 8;
/// Shares of the mean diagonal of the normal equations: of second differences of the change, and of the change itself, which hold what
/// the face leaves open, as the slide of a tool along itself.
constexpr double kFair = 1e-3, kStill = 1e-7;

/// A point of the face and what is to be left there.
struct Aim {
  Vec3 point = Vec3::Zero();
  double wanted_mm = 0.0, area = 0.0;
  std::vector<double> added_mm;  ///< by the machine, to what each motion leaves
};

/// The motion that leaves the least there, with what the machine adds.
struct Touch {
  SweptContact contact;
  double off_mm = 0.0;  ///< of what is wanted
};

std::vector<Touch> touches(const std::vector<Aim>& aims, const std::vector<RuledMotion>& motions,
                           const RadialFunction& tool) {
  std::vector<SweptEstimate> swept;
  for (const RuledMotion& motion : motions)
    swept.emplace_back(std::vector<RuledMotion>{motion}, tool, kPosesPerPoint * motion.tip.count());
  std::vector<Touch> all(aims.size());
  parallel_for(aims.size(), [&](std::size_t k) {
    all[k].off_mm = std::numeric_limits<double>::infinity();
    for (std::size_t m = 0; m < swept.size(); ++m) {
      SweptContact contact = swept[m].refine(aims[k].point, swept[m].nearest(aims[k].point));
      const double off = contact.f + aims[k].added_mm[m] - aims[k].wanted_mm;
      if (!(off < all[k].off_mm)) continue;
      contact.motion = static_cast<int>(m);
      all[k] = {contact, off};
    }
  });
  return all;
}

/// Points all over the face and on its border, but for those that the old motions leave unfinished.
std::vector<Aim> aims_of(const AimProblem& problem) {
  const double spacing = std::sqrt(problem.target->area()) / kPointsPerSide;
  const std::vector<double> nothing(problem.motions.size(), 0.0);
  std::vector<Aim> all;
  for (const SurfaceSample& sample : problem.target->samples(spacing))
    all.push_back({sample.point, 0.0, sample.area, nothing});
  for (const Vec3& p : problem.target->border_points(spacing))
    all.push_back({p, 0.0, 0.5 * spacing * spacing, nothing});
  const std::vector<Touch> old = touches(all, problem.motions, problem.tool);
  std::vector<Aim> aims;
  for (std::size_t k = 0; k < all.size(); ++k) {
    all[k].wanted_mm = old[k].contact.f;
    if (old[k].contact.f <= kUnfinished * problem.tolerance_mm) aims.push_back(std::move(all[k]));
  }
  parallel_for(aims.size(), [&](std::size_t k) {
    for (std::size_t m = 0; m < nothing.size(); ++m) aims[k].added_mm[m] = problem.added_mm(aims[k].point, m);
  });
  return aims;
}

/// Weighted mean square of what is off; infinite where a motion has lost its values.
double cost_of(const std::vector<Aim>& aims, const std::vector<Touch>& at) {
  double squares = 0.0, areas = 0.0;
  for (std::size_t k = 0; k < aims.size(); ++k) {
    squares += aims[k].area * at[k].off_mm * at[k].off_mm;
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
  constexpr std::array<double, 3> kSecond{1.0, -2.0, 1.0};
  for (Eigen::Index k = 0; k + 2 < kChangePoints; ++k)
    for (Eigen::Index i = 0; i < 6; ++i)
      for (Eigen::Index a = 0; a < 3; ++a)
        for (Eigen::Index b = 0; b < 3; ++b)
          normal(6 * (k + a) + i, 6 * (k + b) + i) +=
              kFair * unit * kSecond[static_cast<std::size_t>(a)] * kSecond[static_cast<std::size_t>(b)];
  normal.diagonal().array() += kStill * unit;
}

/// A Gauss-Newton step of the change of one motion, from the places where it leaves the least.
Eigen::VectorXd step_from(const std::vector<Aim>& aims, const std::vector<Touch>& at, int pass,
                          const RuledMotion& motion, const std::vector<double>& knots) {
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(kUnknowns, kUnknowns);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(kUnknowns);
  for (std::size_t k = 0; k < aims.size(); ++k) {
    if (at[k].contact.motion != pass || !std::isfinite(at[k].off_mm)) continue;
    const Row row = row_of(at[k].contact, motion, knots);
    constexpr Eigen::Index kActive = 6 * (kDegree + 1);
    normal.block<kActive, kActive>(6 * row.first, 6 * row.first) += aims[k].area * row.slopes * row.slopes.transpose();
    right.segment<kActive>(6 * row.first) -= aims[k].area * at[k].off_mm * row.slopes;
  }
  if (!(normal.trace() > 0.0)) return right;
  add_smoothing(normal);
  return normal.ldlt().solve(right);
}

/// The motion with a change added to its rails.
RuledMotion changed(const RuledMotion& motion, const Eigen::VectorXd& step, const std::vector<double>& knots) {
  constexpr int kPerPoint = 4;
  BSplineCurve3 tip, direction;
  tip.degree = direction.degree = kDegree;
  tip.knots = direction.knots = knots;
  tip.poles.resize(3, kChangePoints);
  direction.poles.resize(3, kChangePoints);
  for (Eigen::Index k = 0; k < kChangePoints; ++k) {
    tip.poles.col(k) = step.segment<3>(6 * k);
    direction.poles.col(k) = step.segment<3>(6 * k + 3) / motion.axis_length;
  }
  const int count = motion.tip.count(), places = kPerPoint * count;
  Eigen::Matrix3Xd tips(3, places), directions(3, places);
  std::vector<double> t;
  for (int i = 0; i < places; ++i) {
    t.push_back(static_cast<double>(i) / (places - 1));
    tips.col(i) = tip.value(t.back());
    directions.col(i) = direction.value(t.back());
  }
  RuledMotion next = motion;
  next.tip.poles += fit_curve(tips, t, kDegree, count).poles;
  next.direction.poles += fit_curve(directions, t, kDegree, count).poles;
  return next;
}

}  // namespace

AimedMotions aimed_motions(const AimProblem& problem) {
  constexpr double kSettled = 0.999;  // of the cost
  const std::vector<Aim> aims = aims_of(problem);
  const std::vector<double> knots = uniform_knots(kDegree, kChangePoints);
  AimedMotions out{problem.motions, 0.0, 0.0};
  std::vector<Touch> at = touches(aims, out.motions, problem.tool);
  double cost = cost_of(aims, at);
  for (int k = 0; k < kSteps; ++k) {
    std::vector<RuledMotion> next;
    for (std::size_t m = 0; m < out.motions.size(); ++m)
      next.push_back(changed(out.motions[m], step_from(aims, at, static_cast<int>(m), out.motions[m], knots), knots));
    std::vector<Touch> there = touches(aims, next, problem.tool);
    const double less = cost_of(aims, there);
    if (!(less < cost)) break;
    const bool settled = less > kSettled * cost;
    out.motions = std::move(next);
    at = std::move(there);
    cost = less;
    if (settled) break;
  }
  out.rms_mm = std::sqrt(cost);
  for (const Touch& touch : at) out.largest_mm = std::max(out.largest_mm, std::abs(touch.off_mm));
  return out;
}

}  // namespace flank::internal
