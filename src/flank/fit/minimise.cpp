#include "flank/fit/minimise.h"

#include <algorithm>
#include <cmath>

namespace flank {

ResidualSummary summarise_residuals(const FitModel& model, const FitState& state) {
  ResidualSummary summary;
  std::size_t inside = 0, all = 0;
  double squares = 0.0;
  const int n = model.samples_s();
  std::vector<double> radius(n);
  const double length = state.motions.front().axis_length;
  for (int j = 0; j < n; ++j) radius[j] = state.tool.at(length * j / (n - 1)).r;
  for (const std::vector<Footpoint>& feet : state.feet) {
    for (std::size_t k = 0; k < feet.size(); ++k) {
      ++all;
      if (feet[k].location != Location::kInside) continue;
      ++inside;
      const double e = feet[k].distance - radius[k % n];
      squares += e * e;
      summary.largest_mm = std::max(summary.largest_mm, std::abs(e));
      summary.largest_overcut_mm = std::max(summary.largest_overcut_mm, -e);
    }
  }
  if (inside > 0) summary.rms_mm = std::sqrt(squares / static_cast<double>(inside));
  if (all > 0) summary.inside_share = static_cast<double>(inside) / static_cast<double>(all);
  return summary;
}

namespace {

IterationTrace trace_entry(const FitModel& model, const FitState& state, double cost, double damping) {
  const ResidualSummary summary = summarise_residuals(model, state);
  return {cost, summary.rms_mm, summary.largest_mm, damping};
}

}  // namespace

MinimiseResult minimise(const FitModel& model, FitState start) {
  constexpr double kFirstDamping = 1e-9, kLeastDamping = 1e-14, kMostDamping = 1e8;
  MinimiseResult result;
  FitState state = std::move(start);
  model.find_feet(state);
  ArrowSystem system = model.make_system();
  Eigen::VectorXd step;
  double damping = kFirstDamping;
  auto weights = model.sample_weights(state);
  result.trace.push_back(trace_entry(model, state, model.cost(state, weights), damping));
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
      model.find_feet(trial);
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
    result.trace.push_back(trace_entry(model, state, trial_cost, damping));
    small_steps = cost - trial_cost < model.stage().step_tolerance * cost ? small_steps + 1 : 0;
    if (small_steps >= 2 || trial_cost == 0.0) {
      result.status = MinimiseStatus::kConverged;
      break;
    }
  }
  result.state = std::move(state);
  return result;
}

}  // namespace flank
