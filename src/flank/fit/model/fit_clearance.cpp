// The terms of FitModel that keep the flank out of other faces (MATH section 7): one-sided, at points of the axis.
#include <algorithm>
#include <cmath>
#include <limits>

#include "flank/base/parallel.h"
#include "flank/fit/model/fit_model.h"

namespace flank::internal {
namespace {

/// A distance is measured this many radii far, so that it need not be measured again until the sample has moved by what
/// is more than one. More would make each measurement slower, less would make more of them.
constexpr double kSight = 1.2;
/// A distance d bends by at most moved^2 / (2 d): where that is below half of this share of the allowance, it is carried
/// on by its gradient instead of being measured again. Steps become small long before a fit ends.
constexpr double kStraightShare = 0.1;
/// Poses that one task of the parallel loop takes: some hundred distances, long against the cost of starting a task.
constexpr std::size_t kPosesPerTask = 8;

/// Of a point that has no place: such a state has no cost, and the next one is measured anew.
ObstacleSample no_sample(const Vec3& p) {
  ObstacleSample sample;
  sample.at = p;
  sample.nearest.distance_mm = std::numeric_limits<double>::quiet_NaN();
  sample.nearest.face = 0;
  return sample;
}

/// Whether the sample still tells the distance at p, where the flank needs `needed_mm`: carried on if it does.
bool carried_on(ObstacleSample& sample, const Vec3& p, double needed_mm, double allowance_mm) {
  if (!sample.known) return false;
  const Vec3 way = p - sample.at;
  const double moved = way.norm();
  // The distance changes by no more than the point moves: what was far enough may still be.
  if (sample.measured_mm - moved > needed_mm) {
    sample.nearest.distance_mm = sample.measured_mm;
    return true;
  }
  const bool straight =
      sample.nearest.face >= 0 && moved * moved <= kStraightShare * allowance_mm * std::abs(sample.measured_mm);
  if (straight) sample.nearest.distance_mm = sample.measured_mm + sample.nearest.gradient.dot(way);
  return straight;
}

}  // namespace

void FitModel::locate_obstacles(FitState& state) const {
  if (obstacles_.empty()) return;
  const int n = stage_.samples_s;
  state.obstacles.resize(targets_.size());
  std::vector<double> needed(n);
  const auto stride = static_cast<std::size_t>(stage_.clear_stride);
  for (int j = 0; j < n; ++j) needed[j] = std::max(0.0, state.tool.at(s_[j]).r);
  for (std::size_t m = 0; m < targets_.size(); ++m) {
    if (obstacles_[m] == nullptr) continue;
    std::vector<ObstacleSample>& samples = state.obstacles[m];
    samples.resize(static_cast<std::size_t>(n * stage_.samples_t));
    parallel_blocks(static_cast<std::size_t>(stage_.samples_t), kPosesPerTask, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        // First and last always: an end is where a flank is deepest in a wall.
        if (i % stride != 0 && i + 1 < times_.size()) continue;
        const PoseAt pose = pose_at(state.motions[m], times_[i]);
        for (int j = 0; j < n; ++j) {
          ObstacleSample& sample = samples[i * static_cast<std::size_t>(n) + static_cast<std::size_t>(j)];
          const Vec3 p = pose.tip + s_[j] * pose.u;
          if (!p.allFinite() || !std::isfinite(needed[j])) {
            sample = no_sample(p);
            continue;
          }
          if (carried_on(sample, p, needed[j], obstacles_[m]->allowance_mm())) continue;
          sample.nearest =
              stage_.clear_estimated ? obstacles_[m]->estimate(p) : obstacles_[m]->interpolated(p, kSight * needed[j]);
          sample.measured_mm = sample.nearest.distance_mm;
          sample.at = p;
          sample.known = true;
        }
      }
    });
  }
}

double FitModel::intrusion(const FitState& state, std::size_t motion, std::size_t k, double radius) const {
  const ObstacleDistance& nearest = state.obstacles[motion][k].nearest;
  // Beyond the horizon nothing is near: distance_mm is the horizon then, which must not be taken for a distance.
  if (nearest.face < 0) return 0.0;
  const double depth = radius - obstacles_[motion]->allowance_mm() - nearest.distance_mm;
  return std::isnan(depth) ? depth : std::max(0.0, depth);
}

double FitModel::obstacle_cost(const FitState& state) const {
  const std::size_t n = static_cast<std::size_t>(stage_.samples_s);
  double sum = 0.0;
  for (std::size_t m = 0; m < obstacles_.size(); ++m) {
    if (obstacles_[m] == nullptr) continue;
    for (std::size_t k = 0; k < state.obstacles[m].size(); ++k) {
      const double e = intrusion(state, m, k, state.tool.at(s_[k % n]).r);
      sum += e * e;
    }
  }
  return sum * obstacle_weight();
}

double FitModel::obstacle_weight() const {
  const double asked = static_cast<double>(stage_.samples_s) * stage_.samples_t / stage_.clear_stride;
  return stage_.clear_weight / (static_cast<double>(targets_.size()) * asked);
}

void FitModel::assemble_obstacles(const FitState& state, ArrowSystem& system) const {
  const std::size_t n = static_cast<std::size_t>(stage_.samples_s);
  if (obstacles_.empty()) return;
  Eigen::MatrixXd b;
  tool_gradients(state, b);
  PoseTerms terms;
  for (std::size_t m = 0; m < obstacles_.size(); ++m) {
    for (std::size_t i = 0; obstacles_[m] != nullptr && i < times_.size(); ++i) {
      const PoseAt pose = pose_at(state.motions[m], times_[i]);
      terms.matrix.setZero();
      terms.gradient.setZero();
      terms.coupling.setZero(6, tool_parameters_);
      bool any = false;  // most poses are clear of everything: they add nothing
      for (std::size_t j = 0; j < n; ++j) {
        const double e = intrusion(state, m, i * n + j, state.tool.at(s_[j]).r), w = obstacle_weight();
        if (e == 0.0) continue;
        any = true;
        const Vec3& d = state.obstacles[m][i * n + j].nearest.gradient;
        Vec6 g;
        // e = r - allowance - D: de/dpoint = -gradient D, de/dtool = +b; by the pose as in FitModel::row.
        g << -d, (-s_[j] / (axis_length_ * pose.length_w)) * (d - d.dot(pose.u) * pose.u);
        terms.matrix += w * g * g.transpose();
        terms.gradient += w * e * g;
        if (free_.empty()) continue;
        const auto column = b.col(static_cast<Eigen::Index>(j));
        terms.coupling += w * g * column.transpose();
        system.tool_matrix += w * column * column.transpose();
        system.gradient.tail(tool_parameters_) += w * e * column;
      }
      if (any) system.add_pose(static_cast<int>(m), times_[i].first, times_[i].basis.data(), terms, !free_.empty());
    }
  }
}

}  // namespace flank::internal
