#include "flank/fit/model/fit_model.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "flank/base/assert.h"
#include "flank/fit/model/tool_excess.h"

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
      obstacles_(std::move(obstacles)),
      free_(std::move(free_parameters)),
      bounds_(bounds),
      stage_(stage),
      axis_length_(start.motions.front().axis_length),
      tool_parameters_(static_cast<int>(free_.size())) {
  FLANK_ASSERT(targets_.size() == start.motions.size());
  FLANK_ASSERT(obstacles_.empty() || obstacles_.size() == targets_.size());
  FLANK_ASSERT(stage.samples_t >= 2 && stage.samples_s >= 2);
  FLANK_ASSERT(std::all_of(start.motions.begin(), start.motions.end(),
                           [&](const RuledMotion& m) { return m.tip.count() == stage.control_points; }));
  const RuledMotion& first = start.motions.front();
  for (int i = 0; i < stage.samples_t; ++i) {
    TimeSample time{};
    time.t = static_cast<double>(i) / (stage.samples_t - 1);
    const int span = find_span(3, first.tip.knots, time.t);
    std::array<double, 12> n;
    basis_derivatives(3, first.tip.knots, span, time.t, 2, n.data());
    time.first = span - 3;
    std::copy_n(n.data(), 4, time.basis.data());
    std::copy_n(n.data() + 4, 4, time.basis_d1.data());
    // From second derivatives to second differences from sample to sample: what fairness weighs.
    const double h = 1.0 / (stage.samples_t - 1);
    for (int k = 0; k < 4; ++k) time.basis_d2[k] = n[8 + k] * h * h;
    times_.push_back(time);
  }
  for (int j = 0; j < stage.samples_s; ++j) {
    s_.push_back(axis_length_ * j / (stage.samples_s - 1));
    const RadialJet jet = start.tool.at(s_.back());
    start_radius_.push_back(jet.r);
    start_slope_.push_back(jet.d1);
  }
  bound_places_ = stage.bounds_at_knots ? bound_places(start.tool, s_) : s_;
  for (const RuledMotion& motion : start.motions) add_anchors(motion);
}

void FitModel::add_anchors(const RuledMotion& motion) {
  constexpr int kAround = 20;  // an average over a twentieth of the motion to either side
  std::vector<Anchor> anchors;
  std::vector<Vec3> across;
  // Drift is counted along the velocity that the start has at each time, so moving sideways off the path is free.
  for (const TimeSample& time : times_) {
    const AxisJet axis = motion.jet(time.t);
    const Vec3 v = axis.velocity(0.5 * axis_length_);
    across.push_back(v - v.dot(axis.u) * axis.u);
    anchors.push_back({axis.at(0.5 * axis_length_), across.back().normalized(), axis.tip, axis.u, Vec3::Zero()});
  }
  const int n = stage_.samples_t, around = std::max(1, n / kAround);
  std::vector<double> speeds(s_.size(), 0.0);
  for (int i = 0; i < n; ++i) {
    Vec3 sum = Vec3::Zero();
    for (int k = std::max(0, i - around); k <= std::min(n - 1, i + around); ++k) sum += across[k];
    Anchor& anchor = anchors[static_cast<std::size_t>(i)];
    anchor.way = sum.normalized();
    const AxisJet axis = motion.jet(times_[static_cast<std::size_t>(i)].t);
    for (std::size_t j = 0; j < s_.size(); ++j) speeds[j] += axis.velocity(s_[j]).dot(anchor.way) / n;
  }
  for (double& speed : speeds) speed = std::max(0.0, speed);
  anchors_.push_back(std::move(anchors));
  speeds_.push_back(std::move(speeds));
}

ArrowSystem FitModel::make_system() const {
  return ArrowSystem(std::vector<int>(targets_.size(), stage_.control_points), tool_parameters_);
}

FitModel::PoseAt FitModel::pose_at(const RuledMotion& motion, const TimeSample& time) const {
  PoseAt pose;
  pose.tip.setZero();
  pose.w.setZero();
  for (int k = 0; k < 4; ++k) {
    pose.tip += time.basis[k] * motion.tip.poles.col(time.first + k);
    pose.w += time.basis[k] * motion.direction.poles.col(time.first + k);
  }
  pose.length_w = pose.w.norm();
  pose.u = pose.w / pose.length_w;
  return pose;
}

void FitModel::locate(FitState& state) const {
  locate_obstacles(state);
  const int n = stage_.samples_s;
  state.feet.resize(targets_.size());
  for (std::size_t m = 0; m < targets_.size(); ++m) {
    std::vector<Footpoint>& feet = state.feet[m];
    // Warm: each sample follows its own last footpoint. Cold (the first time, or another grid): each follows its
    // neighbour, so that all lie on one branch of the target and only the very first is searched for.
    const bool warm = static_cast<int>(feet.size()) == n * stage_.samples_t;
    if (!warm) feet.assign(static_cast<std::size_t>(n * stage_.samples_t), Footpoint{});
    for (int i = 0; i < stage_.samples_t; ++i) {
      const PoseAt pose = pose_at(state.motions[m], times_[i]);
      for (int j = 0; j < n; ++j) {
        Footpoint& foot = feet[static_cast<std::size_t>(i * n + j)];
        const Footpoint* hint = &foot;
        if (!warm && j > 0) hint = &foot - 1;
        if (!warm && j == 0 && i > 0) hint = &foot - n;
        const Vec3 p = pose.tip + s_[j] * pose.u;
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
  const PoseAt pose = pose_at(state.motions[motion], times_[i]);
  return pose.tip + s_[j] * pose.u;
}

double FitModel::residual(const FitState& state, int motion, int i, int j) const {
  const Footpoint& foot = state.feet[motion][static_cast<std::size_t>(i * stage_.samples_s + j)];
  return foot.distance - state.tool.at(s_[j]).r;
}

std::vector<std::vector<double>> FitModel::sample_weights(const FitState& state) const {
  const int n = stage_.samples_s;
  std::vector<double> radius(n);
  for (int j = 0; j < n; ++j) radius[j] = state.tool.at(s_[j]).r;
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

Vec6 FitModel::row(const PoseAt& pose, double s, const Footpoint& foot) const {
  const Vec3 n = distance_gradient(pose.tip + s * pose.u, foot);
  Vec6 g;
  g.head<3>() = n;
  // u = w / |w|: du = (I - u u') dw / |w|, so only the part of n across the axis turns it. The direction is scaled by
  // the axis length, so that all six coordinates are lengths and one damping fits them.
  g.tail<3>() = (s / (axis_length_ * pose.length_w)) * (n - n.dot(pose.u) * pose.u);
  return g;
}

Eigen::VectorXd FitModel::tool_gradient(const RadialFunction& tool, double s) const {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(tool.parameter_count());
  tool.gradient(s, all.data());
  return all(free_);
}

void FitModel::tool_gradients(const FitState& state, Eigen::MatrixXd& gradients) const {
  gradients.setZero(tool_parameters_, stage_.samples_s);
  if (free_.empty()) return;
  for (int j = 0; j < stage_.samples_s; ++j) gradients.col(j) = tool_gradient(state.tool, s_[j]);
}

double FitModel::cost(const FitState& state, const std::vector<std::vector<double>>& weights) const {
  FLANK_ASSERT(weights.size() == targets_.size() && state.feet.size() == targets_.size());
  const int n = stage_.samples_s;
  std::vector<double> radius(n);
  for (int j = 0; j < n; ++j) radius[j] = state.tool.at(s_[j]).r;
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
  for (int j = 0; j < n; ++j) radius[j] = state.tool.at(s_[j]).r;
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
  Eigen::MatrixXd b;
  tool_gradients(state, b);
  Eigen::VectorXd column_weight = Eigen::VectorXd::Zero(n), column_factor = Eigen::VectorXd::Zero(n);
  PoseTerms terms;
  Eigen::Matrix<double, 6, Eigen::Dynamic> weighted(6, n);
  for (int i = 0; i < stage_.samples_t; ++i) {
    const PoseAt pose = pose_at(state.motions[motion], times_[i]);
    terms.matrix.setZero();
    terms.gradient.setZero();
    for (int j = 0; j < n; ++j) {
      const std::size_t k = static_cast<std::size_t>(i * n + j);
      const Vec6 g = row(pose, s_[j], state.feet[motion][k]);
      weighted.col(j) = weights[k] * g;
      terms.matrix.noalias() += weighted.col(j) * g.transpose();
      terms.gradient += gradient_factors[k] * g;
      column_weight[j] += weights[k];
      column_factor[j] += gradient_factors[k];
    }
    // e = d - r, so de/dtool = -b.
    if (!free_.empty()) terms.coupling.noalias() = -weighted * b.transpose();
    system.add_pose(motion, times_[i].first, times_[i].basis.data(), terms, !free_.empty());
  }
  if (free_.empty()) return;
  system.tool_matrix += b * column_weight.asDiagonal() * b.transpose();
  system.gradient.tail(tool_parameters_) -= b * column_factor;
}

FitState FitModel::moved(const FitState& state, const Eigen::VectorXd& step) const {
  FLANK_ASSERT(step.size() ==
               static_cast<Eigen::Index>(6 * targets_.size()) * stage_.control_points + tool_parameters_);
  FitState next = state;
  for (std::size_t m = 0; m < next.motions.size(); ++m) {
    const int base = static_cast<int>(m) * 6 * stage_.control_points;  // ArrowSystem's order of the unknowns
    for (int k = 0; k < stage_.control_points; ++k) {
      next.motions[m].tip.poles.col(k) += step.segment<3>(base + 6 * k);
      next.motions[m].direction.poles.col(k) += step.segment<3>(base + 6 * k + 3) / axis_length_;
    }
  }
  if (free_.empty()) return next;
  Eigen::VectorXd parameters = state.tool.parameters();
  parameters(free_) += step.tail(tool_parameters_);
  next.tool = state.tool.with_parameters(parameters);
  return next;
}

}  // namespace flank::internal
