#include "flank/fit/solver/interior_point.h"

#include <algorithm>
#include <cmath>

#include "flank/base/assert.h"

namespace flank::internal {
namespace {

/// Slacks z and multipliers y of all gaps, and their steps.
struct Duals {
  std::vector<double> z, y, dz, dy;
};

Duals first_duals(const std::vector<double>& gaps) {
  double spread = 0.0;
  const double count = static_cast<double>(std::max<std::size_t>(1, gaps.size()));
  for (const double c : gaps) spread += std::abs(c);
  spread = std::max(1e-9, spread / count);
  Duals duals;
  for (const double c : gaps) duals.z.push_back(std::max(c, 0.1 * spread));
  // The objective's pull on a gap is about (its weight, 1 / samples) times its size: multipliers start there.
  duals.y.assign(gaps.size(), spread / count);
  duals.dz = duals.dy = duals.y;
  return duals;
}

double complementarity(const Duals& duals) {
  double sum = 0.0;
  for (std::size_t k = 0; k < duals.z.size(); ++k) sum += duals.z[k] * duals.y[k];
  return sum / static_cast<double>(std::max<std::size_t>(1, duals.z.size()));
}

/// Longest step in (0, 1] that keeps value + step * change positive.
double to_boundary(const std::vector<double>& value, const std::vector<double>& change) {
  double step = 1.0;
  for (std::size_t k = 0; k < value.size(); ++k)
    if (change[k] < 0.0) step = std::min(step, -0.995 * value[k] / change[k]);
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
    if (count > 0 && mu < 1e-8 * first_mu) break;
    const double centred = 0.15 * mu;
    system = quadratic;
    system.gradient += quadratic.multiply(x);
    for (std::size_t k = 0; k < count; ++k) {
      const double z = duals.z[k], y = duals.y[k];
      const double infeasible = system.product(problem.rows[k], x) + problem.gaps[k] - z;
      system.add_row(problem.rows[k], y / z, -y - (centred - y * z - y * infeasible) / z);
      duals.dz[k] = infeasible;  // completed below by J dx
    }
    if (!system.solve(1e-13, step)) break;
    for (std::size_t k = 0; k < count; ++k) {
      duals.dz[k] += system.product(problem.rows[k], step);
      duals.dy[k] = (centred - duals.y[k] * duals.z[k] - duals.y[k] * duals.dz[k]) / duals.z[k];
    }
    const double primal = to_boundary(duals.z, duals.dz), dual = to_boundary(duals.y, duals.dy);
    x += primal * step;
    for (std::size_t k = 0; k < count; ++k) {
      duals.z[k] += primal * duals.dz[k];
      duals.y[k] += dual * duals.dy[k];
    }
    if (count == 0) break;
  }
  return x;
}

}  // namespace flank::internal
