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
  for (std::size_t strip = 0; strip < strips.size(); ++strip) {
    const std::vector<Pose> poses = dense(strips[strip].poses, length, step);
    for (std::size_t k = 0; k < poses.size(); k += kGroup) {
      const std::size_t count = std::min(kGroup, poses.size() - k);
      groups_.push_back({poses_.size() + k, poses_.size() + k + count});
      std::vector<Vec3>& hull = hulls.emplace_back();
      for (std::size_t n = k; n < k + count; ++n) hull.push_back(poses[n].tip), hull.push_back(poses[n].at(length));
    }
    poses_.insert(poses_.end(), poses.begin(), poses.end());
    strip_of_.resize(poses_.size(), strip);
  }
  if (!hulls.empty()) tree_ = BoxTree(hulls);
}

bool FinishedPlaces::operator()(const Vec3& x) const {
  if (groups_.empty()) return false;
  bool found = false;
  double squared_reach = kRounding * reach_mm_ * reach_mm_;
  tree_.nearest(x, squared_reach, [&](int group) {
    const Group& at = groups_[static_cast<std::size_t>(group)];
    for (std::size_t k = at.begin; k < at.end && !found; ++k)
      found = near(x - poses_[k].tip, poses_[k].axis).off <= within_mm_;
    // One is enough.
    if (found) squared_reach = 0.0;
  });
  return found;
}

std::optional<SurfaceLeft> FinishedPlaces::left(const Vec3& x) const {
  if (groups_.empty()) return {};
  std::size_t best = 0;
  double least = 1e300, squared_reach = kRounding * reach_mm_ * reach_mm_;
  tree_.nearest(x, squared_reach, [&](int group) {
    const Group& at = groups_[static_cast<std::size_t>(group)];
    for (std::size_t k = at.begin; k < at.end; ++k)
      if (const double off = near(x - poses_[k].tip, poses_[k].axis).off; off < least) least = off, best = k;
  });
  const auto off = [&](double t) {
    const Pose pose = between(best, t);
    return near(x - pose.tip, pose.axis).off;
  };
  // Beside the nearest pose there is one least distance.
  constexpr int kGolden = 40;
  const double share = 0.5 * (std::sqrt(5.0) - 1.0);
  double low = -1.0, high = 1.0;
  for (int k = 0; k < kGolden; ++k) {
    const double a = high - share * (high - low), b = low + share * (high - low);
    (off(a) < off(b) ? high : low) = off(a) < off(b) ? b : a;
  }
  const Pose pose = between(best, 0.5 * (low + high));
  const Near found = near(x - pose.tip, pose.axis);
  if (found.off > within_mm_) return {};
  return SurfaceLeft{found.off, (pose.at(found.s) - x).normalized()};
}

/// `t` in [-1, 1]: towards the one before, or after it, on the same strip.
Pose FinishedPlaces::between(std::size_t pose, double t) const {
  const Pose& a = poses_[pose];
  if ((t < 0.0 && pose == 0) || (t > 0.0 && pose + 1 == poses_.size())) return a;
  const std::size_t other = t < 0.0 ? pose - 1 : pose + 1;
  if (strip_of_[other] != strip_of_[pose]) return a;
  const double share = std::abs(t);
  const Pose& b = poses_[other];
  return {(1.0 - share) * a.tip + share * b.tip, ((1.0 - share) * a.axis + share * b.axis).normalized()};
}

FinishedPlaces::Near FinishedPlaces::near(const Vec3& d, const Vec3& axis) const {
  const double z = d.dot(axis), rho = (d - z * axis).norm(), length = radial_.axis_length();
  if (rho > reach_mm_ || z < -reach_mm_ || z > length + reach_mm_) return {};
  double s = std::clamp(z, 0.0, length), off = rho;
  for (int k = 0; k < 3; ++k) {
    off = std::hypot(z - s, rho);
    s = std::clamp(z + off * radial_.at(s).d1, 0.0, length);
  }
  return {std::hypot(z - s, rho) - radial_.at(s).r, s};
}

}  // namespace flank::internal
