/// Levenberg-Marquardt with iteratively reweighted samples, over any model of the fit: one that locates its contacts
/// (`locate`), weighs its samples (`sample_weights`), fills an ArrowSystem (`assemble`), moves (`moved`), and has a
/// `cost` and a `stage`. FitModel and SweptModel are the two.
#pragma once

#include <cmath>
#include <utility>

#include "flank/base/assert.h"
#include "flank/base/stopping.h"
#include "flank/fit/model/damping.h"
#include "flank/fit/model/minimise_result.h"

namespace flank::internal {

/// Minimises the model from `start`; returns the last accepted state, which is never worse than the start under the
/// weights of its own step. Weights are frozen while a step is sought, and recomputed after it is accepted, so costs of
/// the trace are comparable only if the weights do not change. A start whose cost is not finite returns as it came,
/// with kStalled. Deterministic, unless it is stopped: then it ends with the last accepted state.
template <class Model>
MinimiseResult levenberg_marquardt(const Model& model, FitState start) {
  FLANK_ASSERT(!start.motions.empty() && model.stage().iterations >= 0);
  constexpr double kNoStep = 1e-13;  // of the axis length: such a step is round-off
  // Of the axis length: where a control point goes farther, nothing of the quadratic holds, and contacts are sought from
  // nowhere. Not worth a look.
  constexpr double kFar = 0.2;
  constexpr int kSmallSteps = 2;  // in a row: one small step may only be one that the damping held back
  const auto trace = [&](const FitState& state, double cost, double damping) {
    const ResidualSummary summary = summarise_residuals(model, state);
    return IterationTrace{cost, summary.rms_mm, summary.largest_mm, damping};
  };
  const double length = start.motions.front().axis_length;
  MinimiseResult result;
  FitState state = std::move(start);
  model.locate(state);
  ArrowSystem system = model.make_system();
  Eigen::VectorXd step;
  Damping damping;
  auto weights = model.sample_weights(state);
  result.trace.push_back(trace(state, model.cost(state, weights), damping.value()));
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
    while (!damping.is_spent() && !stopping()) {
      if (!system.solve(damping.value(), step) ||
          step.head(system.tool_offset()).template lpNorm<Eigen::Infinity>() > kFar * length) {
        damping.raise();
        continue;
      }
      trial = model.moved(state, step);
      model.locate(trial);
      trial_cost = model.cost(trial, weights);
      accepted = std::isfinite(trial_cost) && trial_cost < cost;
      if (accepted || step.norm() < kNoStep * length) break;
      damping.refuse();
    }
    if (!accepted) {
      result.status = MinimiseStatus::kStalled;
      break;
    }
    const double promised = -2.0 * system.gradient.dot(step) - step.dot(system.multiply(step));
    damping.accept((cost - trial_cost) / promised);
    state = std::move(trial);
    weights = model.sample_weights(state);
    result.trace.push_back(trace(state, trial_cost, damping.value()));
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
