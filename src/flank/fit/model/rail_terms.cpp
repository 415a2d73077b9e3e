#include "flank/fit/model/rail_terms.h"

#include <algorithm>

#include "flank/base/assert.h"
#include "flank/fit/model/plunge.h"

namespace flank::internal {
namespace {

/// Keeps |w| near one: the length of w is a gauge, this term only holds it (MATH section 2).
constexpr double kUnitPenalty = 1e-9;
/// Of the mean speed of a point of the axis. A fan stands still at its foot, which has no mean speed either.
constexpr double kLeastSpeed = 0.25;

}  // namespace

RailTerms::RailTerms(const AxisGrid& grid, const FitState& start, const FitStage& stage)
    : grid_(grid),
      stage_(stage),
      share_(1.0 / (static_cast<double>(start.motions.size()) * static_cast<double>(grid.times().size()))) {
  for (const double s : grid_.s()) start_slope_.push_back(start.tool.at(s).d1);
  for (const RuledMotion& motion : start.motions) add_anchors(motion);
  if (stage_.parallel_weight > 0.0) lean_alike(start);
}

void RailTerms::lean_alike(const FitState& start) {
  FLANK_ASSERT(start.motions.size() % 2 == 0);
  const double half = 0.5 * grid_.axis_length();
  for (std::size_t m = 0; m < start.motions.size(); m += 2) {
    for (std::size_t i = 0; i < grid_.times().size(); ++i) {
      const double t = grid_.times()[i].t;
      const AxisJet a = start.motions[m].jet(t), b = start.motions[m + 1].jet(t);
      const Vec3 forward = (a.velocity(half).normalized() + b.velocity(half).normalized()).normalized();
      for (const std::size_t motion : {m, m + 1}) {
        anchors_[motion][i].forward = forward;
        anchors_[motion][i].lean = 0.5 * (a.u + b.u).dot(forward);
      }
    }
  }
}

void RailTerms::add_anchors(const RuledMotion& motion) {
  constexpr int kAround = 20;  // an average over a twentieth of the motion to either side
  std::vector<Anchor> anchors;
  std::vector<Vec3> across;
  // Drift is counted along the velocity that the start has at each time, so moving sideways off the path is free.
  for (const AxisGrid::Time& time : grid_.times()) {
    const AxisJet axis = motion.jet(time.t);
    const Vec3 v = axis.velocity(0.5 * grid_.axis_length());
    across.push_back(v - v.dot(axis.u) * axis.u);
    anchors.push_back({axis.at(0.5 * grid_.axis_length()), across.back().normalized(), axis.tip, axis.u, Vec3::Zero()});
  }
  const int n = stage_.samples_t, around = std::max(1, n / kAround);
  std::vector<double> speeds(grid_.s().size(), 0.0);
  for (int i = 0; i < n; ++i) {
    Vec3 sum = Vec3::Zero();
    for (int k = std::max(0, i - around); k <= std::min(n - 1, i + around); ++k) sum += across[k];
    Anchor& anchor = anchors[static_cast<std::size_t>(i)];
    anchor.way = sum.normalized();
    const AxisJet axis = motion.jet(grid_.times()[static_cast<std::size_t>(i)].t);
    for (std::size_t j = 0; j < grid_.s().size(); ++j) speeds[j] += axis.velocity(grid_.s()[j]).dot(anchor.way) / n;
  }
  for (double& speed : speeds) speed = std::max(0.0, speed);
  anchors_.push_back(std::move(anchors));
  speeds_.push_back(std::move(speeds));
}

template <class Visit>
void RailTerms::visit_plunges(const RuledMotion& rails, std::size_t motion, std::size_t i, const Visit& visit) const {
  const AxisGrid::Time& time = grid_.times()[i];
  const Vec3& axis = anchors_[motion][i].axis;
  Vec3 tip = Vec3::Zero(), direction = Vec3::Zero();
  for (int k = 0; k < 4; ++k) {
    tip += time.basis_d1[k] * rails.tip.poles.col(time.first + k);
    direction += time.basis_d1[k] * rails.direction.poles.col(time.first + k);
  }
  const std::vector<double>& s = grid_.s();
  for (std::size_t j = 0; j < s.size(); ++j) visit(s[j], plunge(tip + s[j] * direction, axis, start_slope_[j]));
}

template <class Visit>
void RailTerms::visit_lags(const RuledMotion& rails, std::size_t motion, std::size_t i, const Visit& visit) const {
  const AxisGrid::Time& time = grid_.times()[i];
  const Vec3& way = anchors_[motion][i].way;
  double tip = 0.0, direction = 0.0;
  for (int k = 0; k < 4; ++k) {
    tip += time.basis_d1[k] * way.dot(rails.tip.poles.col(time.first + k));
    direction += time.basis_d1[k] * way.dot(rails.direction.poles.col(time.first + k));
  }
  const std::vector<double>& s = grid_.s();
  for (std::size_t j = 0; j < s.size(); ++j) {
    const double lag = kLeastSpeed * speeds_[motion][j] - (tip + s[j] * direction);
    if (lag > 0.0) visit(s[j], lag, -way);
  }
}

void RailTerms::assemble(const RuledMotion& rails, std::size_t motion, ArrowSystem& system) const {
  for (std::size_t i = 0; i < grid_.times().size(); ++i) {
    assemble_fairness(rails, motion, i, system);
    assemble_anchor(rails, motion, i, system);
    if (weighs_velocities()) assemble_velocities(rails, motion, i, system);
  }
}

// Linear in the control points, with the second derivatives of the basis in the place of its values.
void RailTerms::assemble_fairness(const RuledMotion& rails, std::size_t motion, std::size_t i,
                                  ArrowSystem& system) const {
  const AxisGrid::Time& time = grid_.times()[i];
  PoseTerms terms;
  terms.matrix = Mat6::Identity() * (stage_.fairness * share_);
  for (int k = 0; k < 4; ++k) {
    terms.gradient.head<3>() += time.basis_d2[k] * rails.tip.poles.col(time.first + k);
    terms.gradient.tail<3>() += time.basis_d2[k] * grid_.axis_length() * rails.direction.poles.col(time.first + k);
  }
  terms.gradient *= stage_.fairness * share_;
  system.add_pose(static_cast<int>(motion), time.first, time.basis_d2.data(), terms, false);
}

void RailTerms::assemble_anchor(const RuledMotion& rails, std::size_t motion, std::size_t i,
                                ArrowSystem& system) const {
  const AxisGrid::Time& time = grid_.times()[i];
  const double half = 0.5 * grid_.axis_length();
  const AxisGrid::Pose pose = grid_.pose(rails, i);
  const Anchor& anchor = anchors_[motion][i];
  PoseTerms terms;
  const auto add = [&](const Vec6& g, double e, double weight) {
    terms.matrix += weight * share_ * g * g.transpose();
    terms.gradient += weight * share_ * e * g;
  };
  add(grid_.row(pose, half, anchor.tangent), anchor.tangent.dot(pose.tip + half * pose.u - anchor.middle),
      stage_.transversal_anchor);
  Vec6 g;
  g << anchor.axis, Vec3::Zero();
  add(g, anchor.axis.dot(pose.tip - anchor.tip), stage_.axial_pin);
  g << Vec3::Zero(), pose.u;
  add(g, grid_.axis_length() * (pose.length_w - 1.0), kUnitPenalty);
  if (stage_.parallel_weight > 0.0) {
    g << Vec3::Zero(), grid_.row(pose, grid_.axis_length(), anchor.forward).tail<3>();
    add(g, grid_.axis_length() * (anchor.forward.dot(pose.u) - anchor.lean), stage_.parallel_weight);
  }
  system.add_pose(static_cast<int>(motion), time.first, time.basis.data(), terms, false);
}

void RailTerms::assemble_velocities(const RuledMotion& rails, std::size_t motion, std::size_t i,
                                    ArrowSystem& system) const {
  const AxisGrid::Time& time = grid_.times()[i];
  PoseTerms terms;
  const auto add = [&](double s, double mm, const Vec3& by_velocity, double whole_weight) {
    const double weight = whole_weight / static_cast<double>(grid_.s().size());
    Vec6 g;
    g << by_velocity, s / grid_.axis_length() * by_velocity;
    terms.matrix += weight * share_ * g * g.transpose();
    terms.gradient += weight * share_ * mm * g;
  };
  visit_plunges(rails, motion, i, [&](double s, const Plunge& p) {
    if (p.excess > 0.0) add(s, p.excess, p.gradient, stage_.plunge_weight);
  });
  visit_lags(rails, motion, i, [&](double s, double lag, const Vec3& by) { add(s, lag, by, stage_.lag_weight); });
  system.add_pose(static_cast<int>(motion), time.first, time.basis_d1.data(), terms, false);
}

double RailTerms::cost(const RuledMotion& rails, std::size_t motion) const {
  const double length = grid_.axis_length(), half = 0.5 * length;
  double sum = 0.0;
  for (std::size_t i = 0; i < grid_.times().size(); ++i) {
    const AxisGrid::Time& time = grid_.times()[i];
    Vec3 a = Vec3::Zero(), w = Vec3::Zero();
    for (int k = 0; k < 4; ++k) {
      a += time.basis_d2[k] * rails.tip.poles.col(time.first + k);
      w += time.basis_d2[k] * length * rails.direction.poles.col(time.first + k);
    }
    sum += stage_.fairness * (a.squaredNorm() + w.squaredNorm());
    const AxisGrid::Pose pose = grid_.pose(rails, i);
    const Anchor& anchor = anchors_[motion][i];
    const double drift = anchor.tangent.dot(pose.tip + half * pose.u - anchor.middle);
    const double slide = anchor.axis.dot(pose.tip - anchor.tip);
    const double unit = length * (pose.length_w - 1.0);
    sum += stage_.transversal_anchor * drift * drift + stage_.axial_pin * slide * slide + kUnitPenalty * unit * unit;
    const double lean = length * (anchor.forward.dot(pose.u) - anchor.lean);
    if (stage_.parallel_weight > 0.0) sum += stage_.parallel_weight * lean * lean;
    if (!weighs_velocities()) continue;
    const double places = static_cast<double>(grid_.s().size());
    visit_plunges(rails, motion, i,
                  [&](double, const Plunge& p) { sum += stage_.plunge_weight / places * p.excess * p.excess; });
    visit_lags(rails, motion, i,
               [&](double, double lag, const Vec3&) { sum += stage_.lag_weight / places * lag * lag; });
  }
  return sum / (static_cast<double>(anchors_.size()) * static_cast<double>(grid_.times().size()));
}

}  // namespace flank::internal
