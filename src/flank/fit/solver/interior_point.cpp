#include "flank/fit/solver/interior_point.h"

#include <algorithm>
#include <cmath>

#include "flank/base/assert.h"

namespace flank::internal {
namespace {

// The method: minimise 1/2 x'Hx + g'x subject to J x + c = z, z > 0. With multipliers y > 0 the conditions of a minimum
// are
//   H x + g - J'y = 0,   J x + c - z = 0,   y z = mu for each limit,  mu -> 0.
// One Newton step, with dz and dy eliminated, is (H + J'(y/z)J) dx = -(Hx + g - J'y) + J'(mu - y z - y infeasible)/z
// with infeasible = J x + c - z: rows of weight y/z are added to the arrow, whose shape stays. Slacks let the start
// violate limits.

/// Of the present complementarity, what a step aims at. Fixed, where Mehrotra predicts it, which costs a second
/// solution. Not critical: with 1,600 limits over one motion of 32 control points, 0.02 to 0.3 take 20 to 23
/// iterations, 0.5 takes 32.
constexpr double kCentring = 0.15;
/// Of the way to the boundary, as usual near 1 (Nocedal and Wright, section 14.2). In the same measurement 0.99 to
/// 0.999 make no difference, 0.9 takes two iterations more.
constexpr double kToBoundary = 0.995;
/// Complementarity, against its start, at which the limits hold to more digits than the linearisation does.
constexpr double kConverged = 1e-8;
/// Of the diagonal: H is damped already (add_damping), this is for round-off where y/z has grown large.
constexpr double kDamping = 1e-13;
/// First slacks of violated limits, as a share of the mean |gap|; that mean is at least kLeastSpreadMm, else a start on
/// all limits at once would have no inside.
constexpr double kFirstSlack = 0.1, kLeastSpreadMm = 1e-9;

/// Slacks z and multipliers y of all gaps, and their steps.
struct Duals {
  std::vector<double> z, y, dz, dy;
};

Duals first_duals(const std::vector<double>& gaps) {
  double spread = 0.0;
  const double count = static_cast<double>(std::max<std::size_t>(1, gaps.size()));
  for (const double c : gaps) spread += std::abs(c);
  spread = std::max(kLeastSpreadMm, spread / count);
  Duals duals;
  for (const double c : gaps) duals.z.push_back(std::max(c, kFirstSlack * spread));
  // The objective's pull on a gap is about (its weight, 1 / samples) times its size: multipliers start there.
  duals.y.assign(gaps.size(), spread / count);
  duals.dz = duals.dy = duals.y;
  return duals;
}

/// Mean of y z: how far the point is from a minimum with its limits; 0 there.
double complementarity(const Duals& duals) {
  double sum = 0.0;
  for (std::size_t k = 0; k < duals.z.size(); ++k) sum += duals.z[k] * duals.y[k];
  return sum / static_cast<double>(std::max<std::size_t>(1, duals.z.size()));
}

/// Longest step in (0, 1] that keeps value + step * change positive, and a little away from zero.
double to_boundary(const std::vector<double>& value, const std::vector<double>& change) {
  double step = 1.0;
  for (std::size_t k = 0; k < value.size(); ++k)
    if (change[k] < 0.0) step = std::min(step, -kToBoundary * value[k] / change[k]);
  return step;
}

}  // namespace

Eigen::VectorXd solve_gaps(const GapProblem& problem, int iterations) {
  FLANK_ASSERT(problem.quadratic != nullptr && problem.rows.size() == problem.gaps.size());
  FLANK_ASSERT(std::none_of(problem.gaps.begin(), problem.gaps.end(), [](double gap) { return std::isnan(gap); }));
  const ArrowSystem& quadratic = *problem.quadratic;
  const std::size_t count = problem.gaps.size();
  Duals duals = first_duals(problem.gaps);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(quadratic.size()), step;
  ArrowSystem system = quadratic;
  const double first_mu = complementarity(duals);
  for (int iteration = 0; iteration < iterations; ++iteration) {
    const double mu = complementarity(duals);
    if (count > 0 && mu < kConverged * first_mu) break;
    const double centred = kCentring * mu;
    // Gradient of the quadratic at x; the rows below add the limits' part of matrix and gradient.
    system = quadratic;
    system.gradient += quadratic.multiply(x);
    for (std::size_t k = 0; k < count; ++k) {
      const double z = duals.z[k], y = duals.y[k];
      const double infeasible = system.product(problem.rows[k], x) + problem.gaps[k] - z;
      system.add_row(problem.rows[k], y / z, -y - (centred - y * z - y * infeasible) / z);
      duals.dz[k] = infeasible;  // completed below by J dx
    }
    if (!system.solve(kDamping, step)) break;
    for (std::size_t k = 0; k < count; ++k) {
      duals.dz[k] += system.product(problem.rows[k], step);
      duals.dy[k] = (centred - duals.y[k] * duals.z[k] - duals.y[k] * duals.dz[k]) / duals.z[k];
    }
    // Slacks and multipliers get steps of their own length: one that is blocked does not hold up the others.
    const double primal = to_boundary(duals.z, duals.dz), dual = to_boundary(duals.y, duals.dy);
    x += primal * step;
    for (std::size_t k = 0; k < count; ++k) {
      duals.z[k] += primal * duals.dz[k];
      duals.y[k] += dual * duals.dy[k];
    }
    if (count == 0) break;  // a quadratic without limits is solved by its first step
  }
  return x;
}

}  // namespace flank::internal
