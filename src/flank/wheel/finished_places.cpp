#include "flank/wheel/finished_places.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace flank::internal {
namespace {

constexpr std::size_t kGroup = 12;  ///< poses

}  // namespace

FinishedPlaces::FinishedPlaces(const std::vector<Strip>& strips, const RadialFunction& radial, double within_mm)
    : radial_(radial), within_mm_(within_mm), reach_mm_(radial.largest() + within_mm) {
  for (const Strip& strip : strips)
    for (std::size_t k = 0; k < strip.poses.size(); k += kGroup)
      add({strip.poses.begin() + static_cast<std::ptrdiff_t>(k),
           strip.poses.begin() + static_cast<std::ptrdiff_t>(std::min(k + kGroup, strip.poses.size()))});
}

void FinishedPlaces::add(std::vector<Pose> poses) {
  Group group;
  Box3 box;
  for (const Pose& pose : poses) box.add(pose.tip), box.add(pose.at(radial_.axis_length()));
  group.center = box.center();
  for (const Pose& pose : poses)
    for (const double s : {0.0, radial_.axis_length()})
      group.radius = std::max(group.radius, (pose.at(s) - group.center).norm());
  group.radius += reach_mm_;
  group.poses = std::move(poses);
  groups_.push_back(std::move(group));
}

bool FinishedPlaces::operator()(const Vec3& x) const {
  for (const Group& group : groups_) {
    if ((x - group.center).squaredNorm() > group.radius * group.radius) continue;
    for (const Pose& pose : group.poses)
      if (distance(x - pose.tip, pose.axis) <= within_mm_) return true;
  }
  return false;
}

double FinishedPlaces::distance(const Vec3& d, const Vec3& axis) const {
  const double z = d.dot(axis), rho = (d - z * axis).norm(), length = radial_.axis_length();
  if (rho > reach_mm_ || z < -reach_mm_ || z > length + reach_mm_) return 1e300;
  double s = std::clamp(z, 0.0, length), off = rho;
  for (int k = 0; k < 3; ++k) {
    off = std::hypot(z - s, rho);
    s = std::clamp(z + off * radial_.at(s).d1, 0.0, length);
  }
  return std::hypot(z - s, rho) - radial_.at(s).r;
}

}  // namespace flank::internal
