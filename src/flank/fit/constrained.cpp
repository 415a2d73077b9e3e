#include "flank/fit/constrained.h"

#include <algorithm>
#include <cmath>

#include "flank/fit/interior_point.h"

namespace flank {
namespace {

using Rows = std::vector<std::vector<double>>;

/// Gaps to the real target: a footpoint on the extension is replaced by the closest point of the face itself.
FitState real_feet(const FitModel& model, const FitState& state) {
  FitState real = state;
  const int n = model.samples_s();
  for (std::size_t m = 0; m < real.feet.size(); ++m) {
    for (int i = 0; i < model.samples_t(); ++i) {
      for (int j = 0; j < n; ++j) {
        Footpoint& foot = real.feet[m][static_cast<std::size_t>(i * n + j)];
        if (foot.location == Location::kInside) continue;
        foot = model.target(static_cast<int>(m)).closest(model.point(state, static_cast<int>(m), i, j));
        // Beyond the border the tool may not come nearer than its radius, from whichever side.
        if (foot.location == Location::kBorder) foot.distance = std::abs(foot.distance);
      }
    }
  }
  return real;
}

Rows gaps_of(const FitModel& model, const FitState& real, const Rows& margins, double allowed) {
  Rows gaps = margins;
  for (std::size_t m = 0; m < gaps.size(); ++m)
    for (std::size_t k = 0; k < gaps[m].size(); ++k)
      gaps[m][k] = model.residual(real, static_cast<int>(m), static_cast<int>(k) / model.samples_s(),
                                  static_cast<int>(k) % model.samples_s()) +
                   allowed - margins[m][k];
  return gaps;
}

double violation(const Rows& gaps) {
  double worst = 0.0;
  for (const auto& row : gaps)
    for (double c : row) worst = std::max(worst, -c);
  return worst;
}

/// One run of sequential quadratic programming for fixed margins.
void descend(const FitModel& model, FitState& state, const Rows& margins, const ConstrainedOptions& options,
             ConstrainedResult& result) {
  const auto weights = model.sample_weights(state);
  ArrowSystem quadratic = model.make_system();
  double damping = 1e-6;
  FitState real = real_feet(model, state);
  double cost = model.cost(state, weights),
         worst = violation(gaps_of(model, real, margins, options.allowed_overcut_mm));
  // A violation of one length unit weighs like the cost of all samples being off by it a hundredfold.
  const auto merit = [&](double c, double v) { return c + 100.0 * v * (v + std::sqrt(c)); };
  for (int iteration = 0; iteration < options.steps; ++iteration) {
    model.assemble(state, weights, quadratic);
    quadratic.add_damping(damping);
    const GapProblem problem{&model, &real, &quadratic, gaps_of(model, real, margins, options.allowed_overcut_mm)};
    const Eigen::VectorXd step = solve_gaps(problem, options.interior_iterations);
    FitState trial = model.moved(state, step);
    model.locate(trial);
    FitState trial_real = real_feet(model, trial);
    const double trial_cost = model.cost(trial, weights);
    const double trial_worst = violation(gaps_of(model, trial_real, margins, options.allowed_overcut_mm));
    ++result.steps;
    const double before = merit(cost, worst), after = merit(trial_cost, trial_worst);
    if (!(after < before)) {
      damping *= 30.0;
      if (damping > 1e3) break;
      continue;
    }
    damping = std::max(1e-9, 0.2 * damping);
    state = std::move(trial);
    real = std::move(trial_real);
    cost = trial_cost;
    worst = trial_worst;
    if (before - after < 1e-4 * before) break;
  }
  result.violation_mm = worst;
}

/// Overcut on a grid three times denser, against the real target; each overcut is added to the margin of the model's
/// samples around it.
double add_margins(const FitModel& model, const FitState& state, double allowed, Rows& margins) {
  constexpr int kDenser = 3;
  const int n = model.samples_s(), count_t = kDenser * (model.samples_t() - 1) + 1, count_s = kDenser * (n - 1) + 1;
  double worst = 0.0;
  Rows added = margins;
  for (auto& row : added) std::fill(row.begin(), row.end(), 0.0);
  for (std::size_t m = 0; m < margins.size(); ++m) {
    const Target& target = model.target(static_cast<int>(m));
    std::vector<Footpoint> hints = state.feet[m];
    for (int i = 0; i < count_t; ++i) {
      const Pose pose = state.motions[m].pose(static_cast<double>(i) / (count_t - 1));
      for (int j = 0; j < count_s; ++j) {
        const double s = state.tool.axis_length() * j / (count_s - 1);
        const int near_i = (i + kDenser / 2) / kDenser, near_j = (j + kDenser / 2) / kDenser;
        const Vec3 p = pose.at(s);
        Footpoint foot = target.track(p, hints[static_cast<std::size_t>(near_i * n + near_j)]);
        if (foot.location != Location::kInside) {
          foot = target.closest(p);
          if (foot.location == Location::kBorder) foot.distance = std::abs(foot.distance);
        }
        const double over = state.tool.at(s).r - foot.distance;
        worst = std::max(worst, over);
        if (over <= allowed) continue;
        for (int a = std::max(0, near_i - 1); a <= std::min(model.samples_t() - 1, near_i + 1); ++a)
          for (int b = std::max(0, near_j - 1); b <= std::min(n - 1, near_j + 1); ++b) {
            double& margin = added[m][static_cast<std::size_t>(a * n + b)];
            margin = std::max(margin, over - allowed);
          }
      }
    }
  }
  for (std::size_t m = 0; m < margins.size(); ++m)
    for (std::size_t k = 0; k < margins[m].size(); ++k) margins[m][k] += added[m][k];
  return worst;
}

}  // namespace

ConstrainedResult minimise_constrained(const FitModel& model, FitState start, const ConstrainedOptions& options) {
  ConstrainedResult result;
  FitState state = std::move(start);
  model.locate(state);
  Rows margins;
  for (const auto& feet : state.feet) margins.emplace_back(feet.size(), 0.0);
  result.overcut_mm = 1e300;
  for (int round = 0; round <= options.refinements; ++round) {
    descend(model, state, margins, options, result);
    const double overcut = add_margins(model, state, options.allowed_overcut_mm, margins);
    if (overcut < result.overcut_mm) {
      result.overcut_mm = overcut;
      result.state = state;
    }
    if (overcut <= options.allowed_overcut_mm) break;
  }
  return result;
}

}  // namespace flank
