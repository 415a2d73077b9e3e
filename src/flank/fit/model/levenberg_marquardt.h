/// Levenberg-Marquardt with iteratively reweighted samples, over any model of the fit: one that locates its contacts,
/// weighs its samples, and fills an ArrowSystem.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "flank/base/assert.h"
#include "flank/fit/model/minimise.h"

namespace flank::internal {

/// Minimises the model from `start`. The initial damping is 1e-9 of the mean diagonal (1e-6 crawls, MATH section 7).
template <class Model>
MinimiseResult levenberg_marquardt(const Model& model, FitState start) {
  FLANK_ASSERT(!start.motions.empty() && model.stage().iterations >= 0);
  constexpr double kFirstDamping = 1e-9, kLeastDamping = 1e-14, kMostDamping = 1e8;
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
  // A start that is no motion, or a tool that is none, has nowhere to go.
  if (!std::isfinite(result.trace.back().cost)) {
    result.status = MinimiseStatus::kStalled;
    result.state = std::move(state);
    return result;
  }
  result.status = MinimiseStatus::kIterationLimit;
  int small_steps = 0;
  for (int iteration = 0; iteration < model.stage().iterations; ++iteration) {
    const double cost = model.cost(state, weights);
    model.assemble(state, weights, system);
    FitState trial;
    double trial_cost = cost;
    bool accepted = false;
    for (; damping <= kMostDamping; damping = std::max(10.0 * damping, 1e-8)) {
      if (!system.solve(damping, step)) continue;
      trial = model.moved(state, step);
      model.locate(trial);
      trial_cost = model.cost(trial, weights);
      accepted = std::isfinite(trial_cost) && trial_cost < cost;
      if (accepted) break;
      if (step.norm() < 1e-13 * state.motions.front().axis_length) break;
    }
    if (!accepted) {
      result.status = MinimiseStatus::kStalled;
      break;
    }
    damping = std::max(0.1 * damping, kLeastDamping);
    state = std::move(trial);
    weights = model.sample_weights(state);
    result.trace.push_back(trace(state, trial_cost, damping));
    small_steps = cost - trial_cost < model.stage().step_tolerance * cost ? small_steps + 1 : 0;
    if (small_steps >= 2 || trial_cost == 0.0) {
      result.status = MinimiseStatus::kConverged;
      break;
    }
  }
  result.state = std::move(state);
  return result;
}

}  // namespace flank::internal
