#include "flank/fit/model/constrained.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "flank/base/assert.h"
#include "flank/base/stopping.h"
#include "flank/fit/solver/interior_point.h"

namespace flank::internal {
namespace {

/// Most points that join the constraints in one exchange, the worst first: a quarter of the 1,600 that it begins with.
/// Neighbours of the worst mostly come right with them, and each row costs time in every interior point.
constexpr std::size_t kMostExchanged = 400;

/// Damping of the quadratic, as a share of its diagonal; it makes the matrix positive definite, which the interior
/// point needs. Steps that do not lower the merit are tried again with kMore times as much, up to kMost, where a step
/// is a thousandth of a gradient step; a good one lets it fall by kLess.
constexpr double kFirstDamping = 1e-6, kLeastDamping = 1e-9, kMostDamping = 1e3, kMore = 30.0, kLess = 0.2;

/// Weight of v^2 + v sqrt(c) in the merit, v the largest violation and c the cost, a mean of squares: one point that
/// violates its limit costs as much as all points off by ten times that. The linear term is what makes a penalty exact
/// (a limit is not traded for cost near the minimum), the square is for the start, where c may be near zero.
constexpr double kPenalty = 100.0;

/// A step that lowers the merit by less than this share ends the descent: the next exchange changes more.
constexpr double kSettledShare = 1e-4;

/// What must stay >= 0 at a point, mm.
double gap(const FacePoint& point, const SweptContact& contact, double allowed) {
  return point.one_sided() ? contact.f - point.margin_mm : contact.f + allowed;
}

/// The largest of all points that the model has.
double violation(const SweptModel& model, const FitState& state, double allowed) {
  double worst = 0.0;
  for (std::size_t k = 0; k < state.contacts.size(); ++k)
    worst = std::max(worst, -gap(model.points()[k], state.contacts[k], allowed));
  return worst;
}

/// The limits linearised at the state. Points far above theirs are left out: their rows would cost time and bind
/// nothing.
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

/// One run of sequential quadratic programming for fixed points: robust weights are frozen, steps accepted by a merit.
int descend(const SweptModel& model, FitState& state, const ConstrainedOptions& options) {
  const double allowed = options.allowed_overcut_mm;
  model.locate(state);
  const auto weights = model.sample_weights(state);
  ArrowSystem quadratic = model.make_system();
  double damping = kFirstDamping;
  const auto merit = [&](const FitState& at) {
    const double c = model.cost(at, weights), v = violation(model, at, allowed);
    return c + kPenalty * v * (v + std::sqrt(c));
  };
  double before = merit(state);
  int steps = 0;
  for (; steps < options.steps && !stopping(); ++steps) {
    model.assemble(state, weights, quadratic);
    quadratic.add_damping(damping);
    const Eigen::VectorXd step = solve_gaps(gap_problem(model, state, quadratic, options), options.interior_iterations);
    FitState trial = model.moved(state, step);
    model.locate(trial);
    const double after = merit(trial);
    if (!(after < before)) {
      damping *= kMore;
      if (damping > kMostDamping) break;
      continue;
    }
    damping = std::max(kLeastDamping, kLess * damping);
    state = std::move(trial);
    const bool settled = before - after < kSettledShare * before;
    before = after;
    if (settled) break;
  }
  return steps;
}

/// Appends the dense points that violate their limit, worst first; returns the largest violation.
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
  // They limit, they do not pull: the objective stays that of the first, evenly spread points.
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
  FLANK_ASSERT(options.interior_iterations > 0);
  const auto model_of = [&](const std::vector<FacePoint>& points) {
    return SweptModel(points, problem.targets, start, problem.free_parameters, problem.bounds, problem.stage,
                      problem.obstacles);
  };
  const SweptModel probe = model_of(problem.dense);
  std::vector<FacePoint> points = problem.points;
  ConstrainedResult result;
  result.violation_mm = 1e300;
  FitState state = start;
  for (int round = 0; round <= options.exchanges; ++round) {
    const SweptModel model = model_of(points);
    result.steps += descend(model, state, options);
    if (stopping()) {
      if (round == 0) result.state = state;
      break;
    }
    const std::size_t before = points.size();
    const double worst = exchange(problem, probe, state, options.allowed_overcut_mm, points);
    result.exchanged += static_cast<int>(points.size() - before);
    // Rounds need not improve: new limits can push the motion over old ones that were left out as far away.
    if (worst < result.violation_mm) {
      result.violation_mm = worst;
      result.state = state;
    }
    if (worst <= options.settled_mm) break;
  }
  return result;
}

}  // namespace flank::internal
