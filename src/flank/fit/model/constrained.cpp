#include "flank/fit/model/constrained.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "flank/base/assert.h"
#include "flank/fit/solver/interior_point.h"

namespace flank::internal {
namespace {

/// Most points that join the constraints in one exchange, the worst first.
constexpr std::size_t kMostExchanged = 400;

double gap(const FacePoint& point, const SweptContact& contact, double allowed) {
  return point.one_sided ? contact.f - point.margin_mm : contact.f + allowed;
}

double violation(const SweptModel& model, const FitState& state, double allowed) {
  double worst = 0.0;
  for (std::size_t k = 0; k < state.contacts.size(); ++k)
    worst = std::max(worst, -gap(model.points()[k], state.contacts[k], allowed));
  return worst;
}

GapProblem gap_problem(const SweptModel& model, const FitState& state, const ArrowSystem& quadratic,
                       const ConstrainedOptions& options) {
  GapProblem problem;
  problem.quadratic = &quadratic;
  for (std::size_t k = 0; k < state.contacts.size(); ++k) {
    const double c = gap(model.points()[k], state.contacts[k], options.allowed_overcut_mm);
    if (c > options.band_mm) continue;
    problem.rows.push_back(model.row(state, k));
    problem.gaps.push_back(c);
  }
  return problem;
}

/// One run of sequential quadratic programming for fixed points.
int descend(const SweptModel& model, FitState& state, const ConstrainedOptions& options) {
  const double allowed = options.allowed_overcut_mm;
  model.locate(state);
  const auto weights = model.sample_weights(state);
  ArrowSystem quadratic = model.make_system();
  double damping = 1e-6;
  // A violation of one length unit weighs like the cost of all samples being off by it a hundredfold.
  const auto merit = [&](const FitState& at) {
    const double c = model.cost(at, weights), v = violation(model, at, allowed);
    return c + 100.0 * v * (v + std::sqrt(c));
  };
  double before = merit(state);
  int steps = 0;
  for (; steps < options.steps; ++steps) {
    model.assemble(state, weights, quadratic);
    quadratic.add_damping(damping);
    const Eigen::VectorXd step = solve_gaps(gap_problem(model, state, quadratic, options), options.interior_iterations);
    FitState trial = model.moved(state, step);
    model.locate(trial);
    const double after = merit(trial);
    if (!(after < before)) {
      damping *= 30.0;
      if (damping > 1e3) break;
      continue;
    }
    damping = std::max(1e-9, 0.2 * damping);
    state = std::move(trial);
    const bool settled = before - after < 1e-4 * before;
    before = after;
    if (settled) break;
  }
  return steps;
}

/// Appends the dense points that break their limit, worst first; returns the largest violation.
double exchange(const ConstrainedProblem& problem, const SweptModel& probe, const FitState& state, double allowed,
                std::vector<FacePoint>& points) {
  FitState at = state;
  probe.locate(at);
  std::vector<std::size_t> broken;
  double worst = 0.0;
  for (std::size_t k = 0; k < problem.dense.size(); ++k) {
    const double c = gap(problem.dense[k], at.contacts[k], allowed);
    worst = std::max(worst, -c);
    if (c < 0.0) broken.push_back(k);
  }
  std::stable_sort(broken.begin(), broken.end(), [&](std::size_t a, std::size_t b) {
    return gap(problem.dense[a], at.contacts[a], allowed) < gap(problem.dense[b], at.contacts[b], allowed);
  });
  broken.resize(std::min(broken.size(), kMostExchanged));
  for (const std::size_t k : broken) {
    points.push_back(problem.dense[k]);
    points.back().share = 0.0;
  }
  return worst;
}

}  // namespace

ConstrainedResult minimise_constrained(const ConstrainedProblem& problem, const FitState& start,
                                       const ConstrainedOptions& options) {
  FLANK_ASSERT(problem.targets.size() == start.motions.size());
  FLANK_ASSERT(options.allowed_overcut_mm >= 0.0 && options.interior_iterations > 0);
  const auto model_of = [&](const std::vector<FacePoint>& points) {
    return SweptModel(points, problem.targets, start, problem.free_parameters, problem.bounds, problem.stage,
                      problem.checks);
  };
  const SweptModel probe = model_of(problem.dense);
  std::vector<FacePoint> points = problem.points;
  ConstrainedResult result;
  result.violation_mm = 1e300;
  FitState state = start;
  for (int round = 0; round <= options.exchanges; ++round) {
    const SweptModel model = model_of(points);
    result.steps += descend(model, state, options);
    const std::size_t before = points.size();
    const double worst = exchange(problem, probe, state, options.allowed_overcut_mm, points);
    result.exchanged += static_cast<int>(points.size() - before);
    if (worst < result.violation_mm) {
      result.violation_mm = worst;
      result.state = state;
    }
    if (worst <= options.settled_mm) break;
  }
  return result;
}

}  // namespace flank::internal
