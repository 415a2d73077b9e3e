/// Levenberg-Marquardt with iteratively reweighted samples, over any model of the fit: one that locates its contacts
/// (`locate`), weighs its samples (`sample_weights`), fills an ArrowSystem (`assemble`), moves (`moved`), and has a
/// `cost` and a `stage`. FitModel and SweptModel are the two.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "flank/base/assert.h"
#include "flank/base/stopping.h"
#include "flank/fit/model/minimise_result.h"

namespace flank::internal {

/// Minimises the model from `start`; returns the last accepted state, which is never worse than the start under the
/// weights of its own step. Weights are frozen while a step is sought, and recomputed after it is accepted, so costs of
/// the trace are comparable only if the weights do not change. A start whose cost is not finite returns as it came,
/// with kStalled. Deterministic, unless it is stopped: then it ends with the last accepted state.
template <class Model>
MinimiseResult levenberg_marquardt(const Model& model, FitState start) {
  FLANK_ASSERT(!start.motions.empty() && model.stage().iterations >= 0);
  // Dampings have no unit: shares of the diagonal (ArrowSystem::solve). The first is small, because the problem is
  // nearly quadratic near a good start: 1e-6 crawls (MATH section 7). The least keeps the diagonal above round-off of
  // the factorisation; at the most, a step is 1e-8 of a gradient step and nothing is to be gained any more.
  constexpr double kFirstDamping = 1e-9, kLeastDamping = 1e-14, kMostDamping = 1e8;
  // Ten up, ten down: the classical factor (Marquardt 1963). After a refusal the damping is at least kRetryDamping:
  // between kLeastDamping and there the step hardly changes, and every retry costs all contacts.
  constexpr double kMore = 10.0, kLess = 0.1, kRetryDamping = 1e-8;
  constexpr double kNoStep = 1e-13;  // of the axis length: such a step is round-off
  constexpr int kSmallSteps = 2;     // in a row: one small step may only be one that the damping held back
  const auto trace = [&](const FitState& state, double cost, double damping) {
    const ResidualSummary summary = summarise_residuals(model, state);
    return IterationTrace{cost, summary.rms_mm, summary.largest_mm, damping};
  };
  MinimiseResult result;
  FitState state = std::move(start);
  model.locate(state);
  ArrowSystem system = model.make_system();
  Eigen::VectorXd step;
  double damping = kFirstDamping;
  auto weights = model.sample_weights(state);
  result.trace.push_back(trace(state, model.cost(state, weights), damping));
  // Rails that vanish somewhere, or a family's parameters that describe no tool, give NaN: there is nowhere to go.
  if (!std::isfinite(result.trace.back().cost)) {
    result.status = MinimiseStatus::kStalled;
    result.state = std::move(state);
    return result;
  }
  result.status = MinimiseStatus::kIterationLimit;
  int small_steps = 0;
  for (int iteration = 0; iteration < model.stage().iterations && !stopping(); ++iteration) {
    const double cost = model.cost(state, weights);
    model.assemble(state, weights, system);
    FitState trial;
    double trial_cost = cost;
    bool accepted = false;
    for (; damping <= kMostDamping && !stopping(); damping = std::max(kMore * damping, kRetryDamping)) {
      if (!system.solve(damping, step)) continue;
      trial = model.moved(state, step);
      model.locate(trial);
      trial_cost = model.cost(trial, weights);
      accepted = std::isfinite(trial_cost) && trial_cost < cost;
      if (accepted) break;
      if (step.norm() < kNoStep * state.motions.front().axis_length) break;
    }
    if (!accepted) {
      result.status = MinimiseStatus::kStalled;
      break;
    }
    damping = std::max(kLess * damping, kLeastDamping);
    state = std::move(trial);
    weights = model.sample_weights(state);
    result.trace.push_back(trace(state, trial_cost, damping));
    small_steps = cost - trial_cost < model.stage().step_tolerance * cost ? small_steps + 1 : 0;
    if (small_steps >= kSmallSteps || trial_cost == 0.0) {
      result.status = MinimiseStatus::kConverged;
      break;
    }
  }
  result.state = std::move(state);
  return result;
}

}  // namespace flank::internal
