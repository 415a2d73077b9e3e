#include "flank/cover/line_guard.h"

#include <algorithm>
#include <cmath>

namespace flank {
namespace {

constexpr int kAxisSamples = 13;
constexpr double kBallAxisShare = 1e-4;  ///< a ball is a very short cylinder with round ends

/// Signed distance of a closed solid. A nearest point on a border is a gap between its faces: outside.
double signed_distance(const Footpoint& foot) {
  return foot.location == Location::kInside ? foot.distance : std::abs(foot.distance);
}

bool is_far(const Target& solid, const Vec3& p, double reach) {
  return reach <= 0.0 || solid.box().squared_distance(p) >= reach * reach;
}

}  // namespace

LineGuard::LineGuard(const Tool& tool, const CoverObstacles& obstacles, double floor_mm)
    : obstacles_(&obstacles), floor_mm_(floor_mm) {
  for (int j = 0; j < kAxisSamples; ++j) {
    s_.push_back(tool.radial.axis_length() * j / (kAxisSamples - 1));
    radius_.push_back(tool.radial.at(s_.back()).r);
  }
  ball_radius_ = *std::min_element(radius_.begin(), radius_.end());
  const bool above = !tool.shank.empty() || !tool.holder.empty();
  if (std::any_of(obstacles.surfaces.begin(), obstacles.surfaces.end(),
                  [&](const CheckSurface& c) { return above || !c.flank_may_touch; }))
    checker_ = std::make_shared<const PoseChecker>(tool, obstacles.surfaces);
  if (obstacles.surfaces.empty()) return;
  Tool ball;
  ball.radial =
      RadialFunction(ToolFamily::kCylinder, kBallAxisShare * ball_radius_, Eigen::VectorXd::Constant(1, ball_radius_));
  ball_checker_ = std::make_shared<const PoseChecker>(ball, obstacles.surfaces);
}

bool LineGuard::clear(const Pose& pose) const {
  if (!obstacles_) return true;
  for (const auto& solid : obstacles_->solids) {
    for (std::size_t j = 0; j < s_.size(); ++j) {
      const Vec3 p = pose.at(s_[j]);
      const double reach = radius_[j] + floor_mm_;
      if (!is_far(*solid, p, reach) && signed_distance(solid->closest(p)) < reach) return false;
    }
  }
  return !checker_ || checker_->is_free(pose, floor_mm_);
}

LineClearance LineGuard::measure(const Pose& pose, double horizon_mm) const {
  LineClearance result;
  if (!obstacles_) return result;
  for (const auto& solid : obstacles_->solids) {
    for (std::size_t j = 0; j < s_.size(); ++j) {
      const Vec3 p = pose.at(s_[j]);
      if (is_far(*solid, p, radius_[j] + horizon_mm)) continue;
      const Footpoint foot = solid->closest(p);
      const double clearance = signed_distance(foot) - radius_[j];
      if (clearance < result.clearance_mm) result = {clearance, foot.normal.dot(pose.axis), foot.point};
    }
  }
  if (!checker_) return result;
  const PoseClearance found = checker_->measure(pose, horizon_mm);
  if (found.surface >= 0 && found.clearance_mm < result.clearance_mm)
    result = {found.clearance_mm, found.tip_gradient.dot(pose.axis), found.point};
  return result;
}

bool LineGuard::ball_is_clear(const Vec3& center) const {
  if (!obstacles_) return true;
  const double reach = ball_radius_ + floor_mm_;
  for (const auto& solid : obstacles_->solids)
    if (!is_far(*solid, center, reach) && signed_distance(solid->closest(center)) < reach) return false;
  return !ball_checker_ || ball_checker_->is_free({center, Vec3::UnitZ()}, floor_mm_);
}

Pose slid_clear(const LineGuard& guard, const Pose& pose, double reach_mm) {
  constexpr int kSteps = 6;
  constexpr double kLeastGain = 0.05;  ///< a slide that frees less than this per millimetre leads nowhere
  if (guard.clear(pose)) return pose;
  // A little more than needed: the refinement that follows moves the axis again.
  const double wanted = guard.floor_mm() + 0.3 * std::abs(guard.floor_mm());
  Pose at = pose;
  double slide = 0.0;
  for (int k = 0; k < kSteps; ++k) {
    const LineClearance found = guard.measure(at, std::max(0.1, 4.0 * std::abs(guard.floor_mm())));
    if (found.clearance_mm >= guard.floor_mm() || std::abs(found.slide_gain) < kLeastGain) return at;
    slide = std::clamp(slide + (wanted - found.clearance_mm) / found.slide_gain, -reach_mm, reach_mm);
    at.tip = pose.tip + slide * pose.axis;
  }
  return at;
}

}  // namespace flank
