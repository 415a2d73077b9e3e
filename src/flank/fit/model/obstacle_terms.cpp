#include "flank/fit/model/obstacle_terms.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "flank/base/assert.h"
#include "flank/base/parallel.h"
#include "flank/fit/model/shank_balls.h"

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

ObstacleTerms::ObstacleTerms(const AxisGrid& grid, std::vector<const ObstacleField*> obstacles, const FitStage& stage,
                             const RadialFunction& start, const RadiusBounds& bounds)
    : grid_(grid), bounds_(bounds), places_(grid.s()), stage_(stage), obstacles_(std::move(obstacles)) {
  if (obstacles_.empty()) return;
  const std::vector<double> above = shank_places(start, bounds);
  places_.insert(places_.end(), above.begin(), above.end());
}

std::vector<double> ObstacleTerms::radii(const RadialFunction& tool) const {
  std::vector<double> radii;
  for (const double s : places_) radii.push_back(s > grid_.axis_length() ? shank_ball(tool, bounds_) : tool.at(s).r);
  return radii;
}

void ObstacleTerms::locate(FitState& state) const {
  if (obstacles_.empty()) return;
  FLANK_ASSERT(obstacles_.size() == state.motions.size());
  const std::size_t poses = grid_.times().size();
  const auto stride = static_cast<std::size_t>(stage_.clear_stride);
  state.obstacles.resize(obstacles_.size());
  std::vector<double> needed = radii(state.tool);
  for (double& mm : needed) mm = std::max(0.0, mm);
  for (std::size_t m = 0; m < obstacles_.size(); ++m) {
    if (obstacles_[m] == nullptr) continue;
    std::vector<ObstacleSample>& samples = state.obstacles[m];
    samples.resize(needed.size() * poses);
    parallel_blocks(poses, kPosesPerTask, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        // First and last always: an end is where a flank is deepest in a wall.
        if (i % stride == 0 || i + 1 == poses) locate_pose(state, m, i, needed, samples);
    });
  }
}

void ObstacleTerms::locate_pose(const FitState& state, std::size_t motion, std::size_t time,
                                const std::vector<double>& needed_mm, std::vector<ObstacleSample>& samples) const {
  const ObstacleField& obstacles = *obstacles_[motion];
  const AxisGrid::Pose pose = grid_.pose(state.motions[motion], time);
  for (std::size_t j = 0; j < needed_mm.size(); ++j) {
    ObstacleSample& sample = samples[time * needed_mm.size() + j];
    const Vec3 p = pose.tip + places_[j] * pose.u;
    if (!p.allFinite() || !std::isfinite(needed_mm[j])) {
      sample = no_sample(p);
      continue;
    }
    if (carried_on(sample, p, needed_mm[j], obstacles.allowance_mm())) continue;
    sample.nearest = stage_.clear_estimated ? obstacles.estimate(p) : obstacles.interpolated(p, kSight * needed_mm[j]);
    sample.measured_mm = sample.nearest.distance_mm;
    sample.at = p;
    sample.known = true;
  }
}

double ObstacleTerms::intrusion(const FitState& state, std::size_t motion, std::size_t k, double radius) const {
  const ObstacleDistance& nearest = state.obstacles[motion][k].nearest;
  // Beyond the horizon nothing is near: distance_mm is the horizon then, which must not be taken for a distance.
  if (nearest.face < 0) return 0.0;
  const double depth = radius - obstacles_[motion]->allowance_mm() - nearest.distance_mm;
  return std::isnan(depth) ? depth : std::max(0.0, depth);
}

double ObstacleTerms::weight() const {
  // Of the flank's places: those of a long shank, most of which are in the air, must not make a wall beside the flank softer.
  const double asked =
      static_cast<double>(grid_.s().size()) * static_cast<double>(grid_.times().size()) / stage_.clear_stride;
  return stage_.clear_weight / (static_cast<double>(obstacles_.size()) * asked);
}

double ObstacleTerms::cost(const FitState& state) const {
  if (obstacles_.empty()) return 0.0;
  const std::vector<double> radius = radii(state.tool);
  const std::size_t n = radius.size();
  double sum = 0.0;
  for (std::size_t m = 0; m < obstacles_.size(); ++m) {
    if (obstacles_[m] == nullptr) continue;
    for (std::size_t k = 0; k < state.obstacles[m].size(); ++k) {
      const double e = intrusion(state, m, k, radius[k % n]);
      sum += e * e;
    }
  }
  return sum * weight();
}

void ObstacleTerms::assemble(const FitState& state, const ToolTerms& tool, ArrowSystem& system) const {
  if (obstacles_.empty()) return;
  const std::vector<double> radius = radii(state.tool);
  const std::size_t n = radius.size();
  const bool free_tool = tool.free_count() > 0;
  const Eigen::MatrixXd b = tool.gradients(state.tool);
  // How much the shank's balls grow with the radius of the flank's upper end.
  const double by_shank = bounds_.shank_radius > 0.0 ? 0.0 : kShankGrown;
  const double w = weight();
  PoseTerms terms;
  for (std::size_t m = 0; m < obstacles_.size(); ++m) {
    for (std::size_t i = 0; obstacles_[m] != nullptr && i < grid_.times().size(); ++i) {
      const AxisGrid::Pose pose = grid_.pose(state.motions[m], i);
      terms.matrix.setZero();
      terms.gradient.setZero();
      terms.coupling.setZero(6, tool.free_count());
      bool any = false;  // most poses are clear of everything: they add nothing
      for (std::size_t j = 0; j < n; ++j) {
        const double s = places_[j], e = intrusion(state, m, i * n + j, radius[j]);
        if (e == 0.0) continue;
        any = true;
        // e = r - allowance - D: de/dpoint = -gradient D, de/dtool = +b.
        const Vec6 g = grid_.row(pose, s, -state.obstacles[m][i * n + j].nearest.gradient);
        terms.matrix += w * g * g.transpose();
        terms.gradient += w * e * g;
        if (!free_tool) continue;
        const Eigen::Index at = std::min(static_cast<Eigen::Index>(j), b.cols() - 1);
        const double by = at == static_cast<Eigen::Index>(j) ? 1.0 : by_shank;
        const auto column = b.col(at);
        terms.coupling += w * by * g * column.transpose();
        system.tool_matrix += w * by * by * column * column.transpose();
        system.gradient.tail(tool.free_count()) += w * by * e * column;
      }
      const AxisGrid::Time& time = grid_.times()[i];
      if (any) system.add_pose(static_cast<int>(m), time.first, time.basis.data(), terms, free_tool);
    }
  }
}

}  // namespace flank::internal
