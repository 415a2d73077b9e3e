#include "flank/wheel/finished_places.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace flank::internal {
namespace {

constexpr std::size_t kGroup = 12;  ///< poses
constexpr double kRounding = 1.0 + 1e-9;
constexpr double kBetweenShare =
    1.5;  ///< of sqrt(within * radius): poses that are farther apart have more between them

/// The motion from pose to pose in steps of the tip and of the upper end.
std::vector<Pose> dense(const std::vector<Pose>& poses, double length, double step) {
  std::vector<Pose> out;
  for (std::size_t k = 0; k + 1 < poses.size(); ++k) {
    const Pose &a = poses[k], &b = poses[k + 1];
    const double way = std::max((b.tip - a.tip).norm(), (b.at(length) - a.at(length)).norm());
    const int count = std::max(1, static_cast<int>(std::ceil(way / step)));
    for (int n = 0; n < count; ++n) {
      const double t = static_cast<double>(n) / count;
      out.push_back({(1.0 - t) * a.tip + t * b.tip, ((1.0 - t) * a.axis + t * b.axis).normalized()});
    }
  }
  if (!poses.empty()) out.push_back(poses.back());
  return out;
}

}  // namespace

FinishedPlaces::FinishedPlaces(const std::vector<Strip>& strips, const RadialFunction& radial, double within_mm)
    : radial_(radial), within_mm_(within_mm), reach_mm_(radial.largest() + within_mm) {
  const double length = radial.axis_length(), step = kBetweenShare * std::sqrt(within_mm * radial.smallest());
  std::vector<std::vector<Vec3>> hulls;
  for (const Strip& strip : strips) {
    const std::vector<Pose> poses = dense(strip.poses, length, step);
    for (std::size_t k = 0; k < poses.size(); k += kGroup) {
      groups_.emplace_back(poses.begin() + static_cast<std::ptrdiff_t>(k),
                           poses.begin() + static_cast<std::ptrdiff_t>(std::min(k + kGroup, poses.size())));
      std::vector<Vec3>& hull = hulls.emplace_back();
      for (const Pose& pose : groups_.back()) hull.push_back(pose.tip), hull.push_back(pose.at(length));
    }
  }
  if (!hulls.empty()) tree_ = BoxTree(hulls);
}

bool FinishedPlaces::operator()(const Vec3& x) const {
  if (groups_.empty()) return false;
  bool found = false;
  double squared_reach = kRounding * reach_mm_ * reach_mm_;
  tree_.nearest(x, squared_reach, [&](int group) {
    for (const Pose& pose : groups_[static_cast<std::size_t>(group)])
      if (!found && distance(x - pose.tip, pose.axis) <= within_mm_) found = true;
    // One is enough.
    if (found) squared_reach = 0.0;
  });
  return found;
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
