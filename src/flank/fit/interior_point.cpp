#include "flank/fit/interior_point.h"

#include <algorithm>
#include <cmath>

namespace flank {
namespace {

using Rows = std::vector<std::vector<double>>;

/// Multipliers and slacks of all gaps.
struct Duals {
  Rows slack, multiplier;
};

Duals first_duals(const Rows& gaps, double scale) {
  Duals duals{gaps, gaps};
  for (std::size_t m = 0; m < gaps.size(); ++m) {
    for (std::size_t k = 0; k < gaps[m].size(); ++k) {
      duals.slack[m][k] = std::max(gaps[m][k], scale);
      duals.multiplier[m][k] = 1.0;
    }
  }
  return duals;
}

double complementarity(const Duals& duals) {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t m = 0; m < duals.slack.size(); ++m) {
    for (std::size_t k = 0; k < duals.slack[m].size(); ++k) sum += duals.slack[m][k] * duals.multiplier[m][k];
    count += duals.slack[m].size();
  }
  return sum / static_cast<double>(std::max<std::size_t>(1, count));
}

/// Longest step in (0, 1] that keeps value + step * change positive.
double to_boundary(const Rows& value, const Rows& change) {
  double step = 1.0;
  for (std::size_t m = 0; m < value.size(); ++m)
    for (std::size_t k = 0; k < value[m].size(); ++k)
      if (change[m][k] < 0.0) step = std::min(step, -0.995 * value[m][k] / change[m][k]);
  return step;
}

}  // namespace

Eigen::VectorXd solve_gaps(const GapProblem& problem, int iterations) {
  const ArrowSystem& quadratic = *problem.quadratic;
  const Rows& gaps = problem.gaps;
  double spread = 0.0;
  std::size_t count = 0;
  for (const auto& row : gaps) {
    for (double c : row) spread += std::abs(c);
    count += row.size();
  }
  spread = std::max(1e-9, spread / static_cast<double>(std::max<std::size_t>(1, count)));
  Duals duals = first_duals(gaps, 0.1 * spread);
  // The objective's pull on a gap is about (its weight, 1 / samples) times its size: multipliers start there.
  for (auto& row : duals.multiplier)
    for (double& y : row) y = spread / static_cast<double>(count);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(quadratic.size()), step;
  ArrowSystem system = quadratic;
  Rows scale = gaps, factor = gaps, products = gaps, slack_step = gaps, multiplier_step = gaps;
  const double first_mu = complementarity(duals);
  for (int iteration = 0; iteration < iterations; ++iteration) {
    const double mu = complementarity(duals);
    if (mu < 1e-8 * first_mu) break;
    const double centred = 0.15 * mu;
    system = quadratic;
    system.gradient += quadratic.multiply(x);
    for (std::size_t m = 0; m < gaps.size(); ++m) {
      products[m] = problem.model->row_products(*problem.rows, static_cast<int>(m), x);
      for (std::size_t k = 0; k < gaps[m].size(); ++k) {
        const double z = duals.slack[m][k], y = duals.multiplier[m][k];
        const double infeasible = products[m][k] + gaps[m][k] - z;
        scale[m][k] = y / z;
        factor[m][k] = -y - (centred - y * z - y * infeasible) / z;
        slack_step[m][k] = infeasible;  // completed below by A dx
      }
      problem.model->assemble_rows(*problem.rows, static_cast<int>(m), scale[m], factor[m], system);
    }
    if (!system.solve(1e-13, step)) break;
    for (std::size_t m = 0; m < gaps.size(); ++m) {
      products[m] = problem.model->row_products(*problem.rows, static_cast<int>(m), step);
      for (std::size_t k = 0; k < gaps[m].size(); ++k) {
        const double z = duals.slack[m][k], y = duals.multiplier[m][k];
        slack_step[m][k] += products[m][k];
        multiplier_step[m][k] = (centred - y * z - y * slack_step[m][k]) / z;
      }
    }
    const double primal = to_boundary(duals.slack, slack_step), dual = to_boundary(duals.multiplier, multiplier_step);
    x += primal * step;
    for (std::size_t m = 0; m < gaps.size(); ++m) {
      for (std::size_t k = 0; k < gaps[m].size(); ++k) {
        duals.slack[m][k] += primal * slack_step[m][k];
        duals.multiplier[m][k] += dual * multiplier_step[m][k];
      }
    }
  }
  return x;
}

}  // namespace flank
