#include "flank/fit/model/fit_model.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "flank/base/assert.h"
#include "flank/base/work_count.h"

namespace flank::internal {
namespace {

/// The residual with its dead zone cut out: continuous, with slope 0 inside and 1 outside. Not a number stays what it
/// is: a state without a value must not be cheap.
double effective(double e, double dead_zone) {
  if (dead_zone <= 0.0 || std::isnan(e)) return e;
  return e > 0.0 ? std::max(0.0, e - dead_zone) : std::min(0.0, e + dead_zone);
}
/// Share of its weight that a sample inside the dead zone keeps in the matrix, but not in the gradient: it pulls
/// nowhere, but holds the step. Without it the samples outside, which may be few, would be followed by a Gauss-Newton
/// step that throws the others out; with 1, the step would be as short as that of plain least squares. SweptModel has
/// the same.
constexpr double kDeadZoneDamping = 0.02;
/// mm: a query point this near to a border footpoint lies on the border, and has no direction to it.
constexpr double kOnBorderMm = 1e-12;

/// Of a point that has no place: a step through a direction rail that vanishes. Such a state has no cost.
Footpoint nowhere() {
  Footpoint foot;
  foot.distance = std::numeric_limits<double>::quiet_NaN();
  return foot;
}

}  // namespace

Vec3 distance_gradient(const Vec3& p, const Footpoint& foot) {
  if (foot.location != Location::kBorder) return foot.normal;
  const Vec3 away = p - foot.point;
  const double length = away.norm();
  if (length < kOnBorderMm) return foot.normal;
  return (foot.distance < 0.0 ? -away : away) / length;
}

FitModel::FitModel(std::vector<const Target*> targets, const FitState& start, std::vector<int> free_parameters,
                   const RadiusBounds& bounds, const FitStage& stage, std::vector<const ObstacleField*> obstacles)
    : targets_(std::move(targets)),
      stage_(stage),
      grid_(start.motions.front(), stage.samples_t, stage.samples_s),
      rails_(grid_, start, stage),
      tool_(start.tool, std::move(free_parameters), bounds, stage, grid_.s()),
      obstacles_(grid_, std::move(obstacles), stage, start.tool, bounds) {
  FLANK_ASSERT(targets_.size() == start.motions.size());
  FLANK_ASSERT(std::all_of(start.motions.begin(), start.motions.end(),
                           [&](const RuledMotion& m) { return m.tip.count() == stage.control_points; }));
}

ArrowSystem FitModel::make_system() const {
  return ArrowSystem(std::vector<int>(targets_.size(), stage_.control_points), tool_.free_count());
}

void FitModel::locate(FitState& state) const {
  locate_obstacles(state);
  const int n = stage_.samples_s;
  count_work(targets_.size() * static_cast<std::uint64_t>(n * stage_.samples_t));
  state.feet.resize(targets_.size());
  for (std::size_t m = 0; m < targets_.size(); ++m) {
    std::vector<Footpoint>& feet = state.feet[m];
    // Warm: each sample follows its own last footpoint. Cold (the first time, or another grid): each follows its
    // neighbour, so that all lie on one branch of the target and only the very first is searched for.
    const bool warm = static_cast<int>(feet.size()) == n * stage_.samples_t;
    if (!warm) feet.assign(static_cast<std::size_t>(n * stage_.samples_t), Footpoint{});
    for (int i = 0; i < stage_.samples_t; ++i) {
      const AxisGrid::Pose pose = grid_.pose(state.motions[m], static_cast<std::size_t>(i));
      for (int j = 0; j < n; ++j) {
        Footpoint& foot = feet[static_cast<std::size_t>(i * n + j)];
        const Footpoint* hint = &foot;
        if (!warm && j > 0) hint = &foot - 1;
        if (!warm && j == 0 && i > 0) hint = &foot - n;
        const Vec3 p = pose.tip + grid_.s()[j] * pose.u;
        if (p.allFinite()) {
          foot = targets_[m]->track(p, *hint);
        } else {
          foot = nowhere();
        }
      }
    }
  }
}

Vec3 FitModel::point(const FitState& state, int motion, int i, int j) const {
  const AxisGrid::Pose pose = grid_.pose(state.motions[motion], static_cast<std::size_t>(i));
  return pose.tip + grid_.s()[j] * pose.u;
}

double FitModel::residual(const FitState& state, int motion, int i, int j) const {
  const Footpoint& foot = state.feet[motion][static_cast<std::size_t>(i * stage_.samples_s + j)];
  return foot.distance - state.tool.at(grid_.s()[j]).r;
}

std::vector<std::vector<double>> FitModel::sample_weights(const FitState& state) const {
  const int n = stage_.samples_s;
  std::vector<double> radius(n);
  for (int j = 0; j < n; ++j) radius[j] = state.tool.at(grid_.s()[j]).r;
  std::vector<std::vector<double>> weights(targets_.size());
  const double share = 1.0 / (static_cast<double>(targets_.size()) * n * stage_.samples_t);
  for (std::size_t m = 0; m < targets_.size(); ++m) {
    const std::vector<Footpoint>& feet = state.feet[m];
    weights[m].resize(feet.size());
    for (std::size_t k = 0; k < feet.size(); ++k) {
      const double e = feet[k].distance - radius[k % n];
      const bool inside = feet[k].location == Location::kInside;
      double w = inside ? 1.0 : stage_.extension_weight;
      const double scale = inside ? stage_.robust_scale_mm : stage_.extension_scale_mm;
      // Geman-McClure: the weight whose least squares minimise e^2 / (1 + e^2 / scale^2).
      if (scale > 0.0) {
        const double q = 1.0 + e * e / (scale * scale);
        w /= q * q;
      }
      if (e < 0.0) w *= stage_.overcut_weight;
      weights[m][k] = w * share;
    }
  }
  return weights;
}

double FitModel::regulariser_cost(const FitState& state) const {
  double sum = tool_.cost(state.tool) + obstacles_.cost(state);
  for (std::size_t m = 0; m < targets_.size(); ++m) sum += rails_.cost(state.motions[m], m);
  return sum;
}

void FitModel::assemble_regularisers(const FitState& state, ArrowSystem& system) const {
  for (std::size_t m = 0; m < targets_.size(); ++m) rails_.assemble(state.motions[m], m, system);
  tool_.assemble(state.tool, system);
  obstacles_.assemble(state, tool_, system);
}

double FitModel::cost(const FitState& state, const std::vector<std::vector<double>>& weights) const {
  FLANK_ASSERT(weights.size() == targets_.size() && state.feet.size() == targets_.size());
  const int n = stage_.samples_s;
  std::vector<double> radius(n);
  for (int j = 0; j < n; ++j) radius[j] = state.tool.at(grid_.s()[j]).r;
  double sum = regulariser_cost(state);
  for (std::size_t m = 0; m < targets_.size(); ++m) {
    for (std::size_t k = 0; k < weights[m].size(); ++k) {
      const double e = effective(state.feet[m][k].distance - radius[k % n], stage_.dead_zone_mm);
      sum += weights[m][k] * e * e;
    }
  }
  return sum;
}

void FitModel::assemble(const FitState& state, const std::vector<std::vector<double>>& weights,
                        ArrowSystem& system) const {
  FLANK_ASSERT(weights.size() == targets_.size() && state.feet.size() == targets_.size());
  system.clear();
  const int n = stage_.samples_s;
  // r depends on s alone: once per s, not once per sample.
  std::vector<double> radius(n), factors(static_cast<std::size_t>(n * stage_.samples_t)), matrix_weights;
  for (int j = 0; j < n; ++j) radius[j] = state.tool.at(grid_.s()[j]).r;
  for (std::size_t m = 0; m < targets_.size(); ++m) {
    matrix_weights = weights[m];
    for (std::size_t k = 0; k < factors.size(); ++k) {
      const double e = effective(state.feet[m][k].distance - radius[k % n], stage_.dead_zone_mm);
      factors[k] = weights[m][k] * e;
      if (e == 0.0) matrix_weights[k] *= kDeadZoneDamping;
    }
    assemble_rows(state, static_cast<int>(m), matrix_weights, factors, system);
  }
  assemble_regularisers(state, system);
}

void FitModel::assemble_rows(const FitState& state, int motion, const std::vector<double>& weights,
                             const std::vector<double>& gradient_factors, ArrowSystem& system) const {
  const int n = stage_.samples_s;
  const bool free_tool = tool_.free_count() > 0;
  const Eigen::MatrixXd b = tool_.gradients(state.tool);
  Eigen::VectorXd column_weight = Eigen::VectorXd::Zero(n), column_factor = Eigen::VectorXd::Zero(n);
  PoseTerms terms;
  Eigen::Matrix<double, 6, Eigen::Dynamic> weighted(6, n);
  const std::vector<double>& s = grid_.s();
  for (int i = 0; i < stage_.samples_t; ++i) {
    const AxisGrid::Pose pose = grid_.pose(state.motions[motion], static_cast<std::size_t>(i));
    terms.matrix.setZero();
    terms.gradient.setZero();
    for (int j = 0; j < n; ++j) {
      const std::size_t k = static_cast<std::size_t>(i * n + j);
      const Vec3 p = pose.tip + s[j] * pose.u;
      const Vec6 g = grid_.row(pose, s[j], distance_gradient(p, state.feet[motion][k]));
      weighted.col(j) = weights[k] * g;
      terms.matrix.noalias() += weighted.col(j) * g.transpose();
      terms.gradient += gradient_factors[k] * g;
      column_weight[j] += weights[k];
      column_factor[j] += gradient_factors[k];
    }
    // e = d - r, so de/dtool = -b.
    if (free_tool) terms.coupling.noalias() = -weighted * b.transpose();
    const AxisGrid::Time& time = grid_.times()[static_cast<std::size_t>(i)];
    system.add_pose(motion, time.first, time.basis.data(), terms, free_tool);
  }
  if (!free_tool) return;
  system.tool_matrix += b * column_weight.asDiagonal() * b.transpose();
  system.gradient.tail(tool_.free_count()) -= b * column_factor;
}

FitState FitModel::moved(const FitState& state, const Eigen::VectorXd& step) const {
  FLANK_ASSERT(step.size() ==
               static_cast<Eigen::Index>(6 * targets_.size()) * stage_.control_points + tool_.free_count());
  FitState next = state;
  for (std::size_t m = 0; m < next.motions.size(); ++m) {
    const int base = static_cast<int>(m) * 6 * stage_.control_points;  // ArrowSystem's order of the unknowns
    for (int k = 0; k < stage_.control_points; ++k) {
      next.motions[m].tip.poles.col(k) += step.segment<3>(base + 6 * k);
      next.motions[m].direction.poles.col(k) += step.segment<3>(base + 6 * k + 3) / grid_.axis_length();
    }
  }
  if (tool_.free_count() == 0) return next;
  Eigen::VectorXd parameters = state.tool.parameters();
  parameters(tool_.free()) += step.tail(tool_.free_count());
  next.tool = state.tool.with_parameters(parameters);
  return next;
}

}  // namespace flank::internal
