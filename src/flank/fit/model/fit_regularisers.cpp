// The terms of FitModel that do not look at the targets: fairness and anchors of rails, pins and bounds of the tool.
#include <algorithm>
#include <cmath>

#include "flank/fit/model/fit_model.h"
#include "flank/fit/model/plunge.h"
#include "flank/fit/model/tool_excess.h"

namespace flank::internal {
namespace {

/// Keeps |w| near one: the length of w is a gauge, this term only holds it (MATH section 2).
constexpr double kUnitPenalty = 1e-9;
/// Weight of the one-sided terms (tool_excess.h) that keep the tool inside its bounds, against 1 for the residuals: a
/// bound is broken by a tenth of the error that breaking it would save. Radii that are left out of bounds are clamped at
/// the end (clamp_tool); slenderness and neck are held a little inside theirs.
constexpr double kBoundWeight = 10.0;
/// Of the mean speed of a point of the axis. A fan stands still at its foot, which has no mean speed either.
constexpr double kLeastSpeed = 0.25;

}  // namespace

double FitModel::regulariser_cost(const FitState& state) const {
  double sum = tool_cost(state) + obstacle_cost(state);
  for (std::size_t m = 0; m < targets_.size(); ++m) sum += rail_cost(state, static_cast<int>(m));
  return sum;
}

void FitModel::assemble_regularisers(const FitState& state, ArrowSystem& system) const {
  for (std::size_t m = 0; m < targets_.size(); ++m) assemble_rails(state, static_cast<int>(m), system);
  assemble_tool(state, system);
  assemble_obstacles(state, system);
}

template <class Visit>
void FitModel::visit_plunges(const RuledMotion& rails, const TimeSample& time, const Vec3& axis,
                             const Visit& visit) const {
  Vec3 tip = Vec3::Zero(), direction = Vec3::Zero();
  for (int k = 0; k < 4; ++k) {
    tip += time.basis_d1[k] * rails.tip.poles.col(time.first + k);
    direction += time.basis_d1[k] * rails.direction.poles.col(time.first + k);
  }
  for (std::size_t j = 0; j < s_.size(); ++j) visit(s_[j], plunge(tip + s_[j] * direction, axis, start_slope_[j]));
}

template <class Visit>
void FitModel::visit_lags(const RuledMotion& rails, int motion, std::size_t i, const Visit& visit) const {
  const TimeSample& time = times_[i];
  const Vec3& way = anchors_[motion][i].way;
  double tip = 0.0, direction = 0.0;
  for (int k = 0; k < 4; ++k) {
    tip += time.basis_d1[k] * way.dot(rails.tip.poles.col(time.first + k));
    direction += time.basis_d1[k] * way.dot(rails.direction.poles.col(time.first + k));
  }
  for (std::size_t j = 0; j < s_.size(); ++j) {
    const double lag = kLeastSpeed * speeds_[motion][j] - (tip + s_[j] * direction);
    if (lag > 0.0) visit(s_[j], lag, -way);
  }
}

void FitModel::assemble_rails(const FitState& state, int motion, ArrowSystem& system) const {
  const RuledMotion& rails = state.motions[motion];
  // Means over the samples, as the residuals are, so that weights mean the same on any grid and any number of motions.
  const double share = 1.0 / (static_cast<double>(targets_.size()) * stage_.samples_t);
  const double half = 0.5 * axis_length_;
  PoseTerms terms;
  for (int i = 0; i < stage_.samples_t; ++i) {
    const TimeSample& time = times_[i];
    // Fairness is linear in the control points, with the second derivatives of the basis in the place of its values.
    terms.matrix = Mat6::Identity() * (stage_.fairness * share);
    terms.gradient.setZero();
    for (int k = 0; k < 4; ++k) {
      terms.gradient.head<3>() += time.basis_d2[k] * rails.tip.poles.col(time.first + k);
      terms.gradient.tail<3>() += time.basis_d2[k] * axis_length_ * rails.direction.poles.col(time.first + k);
    }
    terms.gradient *= stage_.fairness * share;
    system.add_pose(motion, time.first, time.basis_d2.data(), terms, false);

    // Anchor, pin and |w| = 1: one row each, derivatives as in FitModel::row.
    const PoseAt pose = pose_at(rails, time);
    const Anchor& anchor = anchors_[motion][static_cast<std::size_t>(i)];
    terms.matrix.setZero();
    terms.gradient.setZero();
    const auto add = [&](const Vec6& g, double e, double weight) {
      terms.matrix += weight * share * g * g.transpose();
      terms.gradient += weight * share * e * g;
    };
    Vec6 g;
    const Vec3 tangent = anchor.tangent;
    g << tangent, (half / (axis_length_ * pose.length_w)) * (tangent - tangent.dot(pose.u) * pose.u);
    add(g, tangent.dot(pose.tip + half * pose.u - anchor.middle), stage_.transversal_anchor);
    g << anchor.axis, Vec3::Zero();
    add(g, anchor.axis.dot(pose.tip - anchor.tip), stage_.axial_pin);
    g << Vec3::Zero(), pose.u;
    add(g, axis_length_ * (pose.length_w - 1.0), kUnitPenalty);
    system.add_pose(motion, time.first, time.basis.data(), terms, false);

    if (stage_.plunge_weight <= 0.0 && stage_.lag_weight <= 0.0) continue;
    terms.matrix.setZero();
    terms.gradient.setZero();
    const auto add_velocity = [&](double s, double mm, const Vec3& by_velocity, double weight) {
      g << by_velocity, s / axis_length_ * by_velocity;
      add(g, mm, weight / static_cast<double>(s_.size()));
    };
    visit_plunges(rails, time, anchor.axis, [&](double s, const Plunge& p) {
      if (p.excess > 0.0) add_velocity(s, p.excess, p.gradient, stage_.plunge_weight);
    });
    visit_lags(rails, motion, static_cast<std::size_t>(i),
               [&](double s, double lag, const Vec3& by) { add_velocity(s, lag, by, stage_.lag_weight); });
    system.add_pose(motion, time.first, time.basis_d1.data(), terms, false);
  }
}

double FitModel::rail_cost(const FitState& state, int motion) const {
  const RuledMotion& rails = state.motions[motion];
  const double half = 0.5 * axis_length_;
  double sum = 0.0;
  for (int i = 0; i < stage_.samples_t; ++i) {
    const TimeSample& time = times_[i];
    Vec3 a = Vec3::Zero(), w = Vec3::Zero();
    for (int k = 0; k < 4; ++k) {
      a += time.basis_d2[k] * rails.tip.poles.col(time.first + k);
      w += time.basis_d2[k] * axis_length_ * rails.direction.poles.col(time.first + k);
    }
    sum += stage_.fairness * (a.squaredNorm() + w.squaredNorm());
    const PoseAt pose = pose_at(rails, time);
    const Anchor& anchor = anchors_[motion][static_cast<std::size_t>(i)];
    const double drift = anchor.tangent.dot(pose.tip + half * pose.u - anchor.middle);
    const double slide = anchor.axis.dot(pose.tip - anchor.tip);
    const double unit = axis_length_ * (pose.length_w - 1.0);
    sum += stage_.transversal_anchor * drift * drift + stage_.axial_pin * slide * slide + kUnitPenalty * unit * unit;
    if (stage_.plunge_weight <= 0.0 && stage_.lag_weight <= 0.0) continue;
    const double places = static_cast<double>(s_.size());
    visit_plunges(rails, time, anchor.axis,
                  [&](double, const Plunge& p) { sum += stage_.plunge_weight / places * p.excess * p.excess; });
    visit_lags(rails, motion, static_cast<std::size_t>(i),
               [&](double, double lag, const Vec3&) { sum += stage_.lag_weight / places * lag * lag; });
  }
  return sum / (static_cast<double>(targets_.size()) * stage_.samples_t);
}

void FitModel::assemble_tool(const FitState& state, ArrowSystem& system) const {
  if (free_.empty()) return;
  const int n = stage_.samples_s;
  Eigen::MatrixXd b;
  tool_gradients(state, b);
  auto gradient = system.gradient.tail(tool_parameters_);
  for (int j = 0; j < n; ++j) {
    const double drift = state.tool.at(s_[j]).r - start_radius_[j];
    system.tool_matrix += (stage_.radius_pin / n) * b.col(j) * b.col(j).transpose();
    gradient += (stage_.radius_pin / n) * drift * b.col(j);
  }
  for (const ToolExcess& excess : tool_excesses(state.tool, bounds_, bound_places_)) {
    const Eigen::VectorXd row = excess.gradient(free_);
    system.tool_matrix += (kBoundWeight * excess.share) * row * row.transpose();
    gradient += (kBoundWeight * excess.share * excess.mm) * row;
  }
  // Second differences of a spline's coefficients; a family has nothing that could wave.
  if (state.tool.family() != ToolFamily::kSpline) return;
  const Eigen::VectorXd& r = state.tool.parameters();
  for (int k = 1; k + 1 < tool_parameters_; ++k) {
    const double e = r[k - 1] - 2.0 * r[k] + r[k + 1];
    const std::array<double, 3> d = {1.0, -2.0, 1.0};
    for (int p = 0; p < 3; ++p) {
      gradient[k - 1 + p] += stage_.tool_fairness * e * d[p];
      for (int q = 0; q < 3; ++q) system.tool_matrix(k - 1 + p, k - 1 + q) += stage_.tool_fairness * d[p] * d[q];
    }
  }
}

double FitModel::tool_cost(const FitState& state) const {
  if (free_.empty()) return 0.0;
  double sum = kBoundWeight * tool_excess_square(state.tool, bounds_, bound_places_);
  for (std::size_t j = 0; j < s_.size(); ++j) {
    const double drift = state.tool.at(s_[j]).r - start_radius_[j];
    sum += stage_.radius_pin * drift * drift / stage_.samples_s;
  }
  if (state.tool.family() != ToolFamily::kSpline) return sum;
  const Eigen::VectorXd& r = state.tool.parameters();
  for (int k = 1; k + 1 < tool_parameters_; ++k) {
    const double e = r[k - 1] - 2.0 * r[k] + r[k + 1];
    sum += stage_.tool_fairness * e * e;
  }
  return sum;
}

}  // namespace flank::internal
