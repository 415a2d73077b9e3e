#include "flank/obstacle/pose_guard.h"

#include <algorithm>
#include <cmath>

#include "flank/base/assert.h"

namespace flank::internal {
namespace {

/// Shortest step of the walk along the axis, as a share of it: used if it is near a solid. At most 33 queries a pose.
constexpr double kShortestStepShare = 1.0 / 32.0;
/// Axis of the ball, in radii: a tool needs an axis, so a ball is a very short cylinder with round ends. The error is
/// half the axis, far below any tolerance.
constexpr double kBallAxisShare = 1e-4;
/// Most steps of Newton in slid_clear: the clearance along the slide is nearly linear, a concave obstacle needs a few
/// more.
constexpr int kSlideSteps = 6;
/// A slide that clears less than this per millimetre leads nowhere: the obstacle lies beside the axis, not along it.
constexpr double kLeastGain = 0.05;
/// A slide aims above the floor by this share of it: the refinement that follows moves the axis again.
constexpr double kSlideMargin = 0.3;
/// Horizon of a slide's measurements: as many floors, and at least so many mm where the floor is 0. Only a clearance
/// below the floor is used, so the horizon just has to lie safely above it.
constexpr double kHorizonFloors = 4.0, kLeastHorizonMm = 0.1;

/// Signed distance of a closed solid. A nearest point on a border is a gap between its faces: outside.
double signed_distance(const Footpoint& foot) {
  return foot.location == Location::kInside ? foot.distance : std::abs(foot.distance);
}

bool is_far(const Target& solid, const Vec3& p, double reach) {
  return reach <= 0.0 || solid.box().squared_distance(p) >= reach * reach;
}

}  // namespace

PoseGuard::PoseGuard(const Tool& tool, const Obstacles& obstacles, double floor_mm)
    : obstacles_(&obstacles),
      ball_radius_(tool.radial.smallest()),
      radial_(tool.radial),
      steepest_(tool.radial.steepest()),
      floor_mm_(floor_mm) {
  // A checker costs memory and a query for every pose. Surfaces that the flank may touch matter for shank and holder
  // only.
  const bool above = !tool.shank.empty() || !tool.holder.empty();
  if (std::any_of(obstacles.meshes.begin(), obstacles.meshes.end(),
                  [&](const ObstacleMesh& c) { return above || !c.flank_may_touch; }))
    checker_ = std::make_shared<const PoseChecker>(tool, obstacles.meshes);
  if (obstacles.meshes.empty()) return;
  Tool ball;
  ball.radial =
      RadialFunction(ToolFamily::kCylinder, kBallAxisShare * ball_radius_, Eigen::VectorXd::Constant(1, ball_radius_));
  ball_checker_ = std::make_shared<const PoseChecker>(ball, obstacles.meshes);
}

/// Replaces `result` if some sphere on the axis is closer to `solid` than `enough_mm` and than what `result` has. A
/// distance is 1-Lipschitz, so where there is room the walk along the axis takes longer steps. Accuracy: half the
/// shortest step. kWhether ends at the first sphere that is too close.
void PoseGuard::measure_solid(const Target& solid, const Pose& pose, double enough_mm, Ask ask,
                              SlideClearance& result) const {
  const double length = radial_.axis_length(), shortest = kShortestStepShare * length;
  for (double s = length, room = 0.0; s >= 0.0;) {
    const Vec3 p = pose.at(s);
    const double r = radial_.at(s).r, wanted = std::min(enough_mm, result.clearance_mm);
    const double away = std::sqrt(solid.box().squared_distance(p));
    // The distance to the solid's box is a lower bound and costs next to nothing.
    if (away > 0.0 && away >= r + wanted) {
      room = away - r - wanted;
    } else {
      const Footpoint foot = solid.closest(p);
      const double clearance = signed_distance(foot) - r;
      room = clearance - wanted;
      if (clearance < wanted) result = {clearance, foot.normal.dot(pose.axis), foot.point};
    }
    if (s == 0.0 || (ask == Ask::kWhether && result.clearance_mm < enough_mm)) return;
    // d(l(s)) changes by at most ds and r(s) by steepest * ds, so the clearance cannot fall to `wanted` within a
    // shorter step.
    s = std::max(0.0, s - std::max(shortest, room / (1.0 + steepest_)));
  }
}

bool PoseGuard::clear(const Pose& pose) const {
  if (!obstacles_) return true;
  for (const auto& solid : obstacles_->solids) {
    SlideClearance found;
    measure_solid(*solid, pose, floor_mm_, Ask::kWhether, found);
    if (found.clearance_mm < floor_mm_) return false;
  }
  return !checker_ || checker_->is_free(pose, floor_mm_);
}

SlideClearance PoseGuard::measure(const Pose& pose, double horizon_mm) const {
  SlideClearance result;
  if (!obstacles_) return result;
  for (const auto& solid : obstacles_->solids) measure_solid(*solid, pose, horizon_mm, Ask::kLeast, result);
  if (!checker_) return result;
  const PoseClearance found = checker_->measure(pose, horizon_mm);
  if (found.surface >= 0 && found.clearance_mm < result.clearance_mm)
    result = {found.clearance_mm, found.tip_gradient.dot(pose.axis), found.point};
  return result;
}

bool PoseGuard::ball_is_clear(const Vec3& center) const {
  if (!obstacles_) return true;
  const double reach = ball_radius_ + floor_mm_;
  for (const auto& solid : obstacles_->solids)
    if (!is_far(*solid, center, reach) && signed_distance(solid->closest(center)) < reach) return false;
  return !ball_checker_ || ball_checker_->is_free({center, Vec3::UnitZ()}, floor_mm_);
}

Pose slid_clear(const PoseGuard& guard, const Pose& pose, double reach_mm) {
  FLANK_ASSERT(reach_mm >= 0.0);
  if (guard.clear(pose)) return pose;
  const double wanted = guard.floor_mm() + kSlideMargin * std::abs(guard.floor_mm());
  Pose at = pose;
  double slide = 0.0;
  for (int k = 0; k < kSlideSteps; ++k) {
    const SlideClearance found =
        guard.measure(at, std::max(kLeastHorizonMm, kHorizonFloors * std::abs(guard.floor_mm())));
    if (found.clearance_mm >= guard.floor_mm() || std::abs(found.slide_gain) < kLeastGain) return at;
    slide = std::clamp(slide + (wanted - found.clearance_mm) / found.slide_gain, -reach_mm, reach_mm);
    at.tip = pose.tip + slide * pose.axis;
  }
  return at;
}

}  // namespace flank::internal
