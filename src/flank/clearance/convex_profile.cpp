#include "flank/clearance/convex_profile.h"

#include <cmath>

namespace flank {
namespace {

constexpr double kSameSlope = 1e-12;

}  // namespace

ConvexProfile::ConvexProfile(const std::vector<Vec2>& corners) {
  Vec2 at(corners.front().x(), 0.0);
  const auto add = [&](const Vec2& to) {
    const double length = (to - at).norm();
    if (length > 0.0) {
      from_.push_back(at);
      along_.emplace_back((to - at) / length);
      length_.push_back(length);
    }
    at = to;
  };
  for (const Vec2& corner : corners) add(corner);
  add({corners.back().x(), 0.0});
  if (from_.empty()) {
    from_.push_back(at);
    along_.emplace_back(0.0, 1.0);
    length_.push_back(0.0);
  }
  const auto count = static_cast<Eigen::Index>(from_.size());
  normal_z_.resize(count);
  normal_rho_.resize(count);
  offset_.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    normal_z_[i] = -along_[k].y();
    normal_rho_[i] = along_[k].x();
    offset_[i] = normal_z_[i] * from_[k].x() + normal_rho_[i] * from_[k].y();
  }
}

BodyJet ConvexProfile::at(const Pose& pose, const Vec3& x) const {
  BodyJet jet;
  const Vec3 d = x - pose.tip;
  jet.z = d.dot(pose.axis);
  const Vec3 perpendicular = d - jet.z * pose.axis;
  jet.rho = perpendicular.norm();
  jet.across = jet.rho > 0.0 ? Vec3(perpendicular / jet.rho) : pose.axis.unitOrthogonal();
  Eigen::Index facing = 0;
  jet.value = (normal_z_ * jet.z + normal_rho_ * jet.rho - offset_).maxCoeff(&facing);
  jet.along = normal_z_[facing];
  jet.out = normal_rho_[facing];
  if (jet.value > 0.0) {
    // Outside: from the side that faces the point most to the one that holds its foot.
    auto k = static_cast<std::size_t>(facing);
    const Vec2 p(jet.z, jet.rho);
    const auto share = [&](std::size_t i) { return along_[i].dot(p - from_[i]); };
    double t = share(k);
    while (t < 0.0 && k > 0 && share(k - 1) <= length_[k - 1]) t = share(--k);
    while (t > length_[k] && k + 1 < from_.size() && share(k + 1) >= 0.0) t = share(++k);
    const bool rim = t <= 0.0 || t >= length_[k];
    const Vec2 off = p - from_[k] - std::min(std::max(t, 0.0), length_[k]) * along_[k];
    jet.value = off.norm();
    if (jet.value > 0.0) {
      jet.along = off.x() / jet.value;
      jet.out = off.y() / jet.value;
      jet.corner = rim ? 1.0 / jet.value : 0.0;
    }
  }
  jet.gradient = jet.along * pose.axis + jet.out * jet.across;
  return jet;
}

std::vector<ConvexProfile> split_convex(const std::vector<Vec2>& profile) {
  std::vector<ConvexProfile> bodies;
  std::vector<Vec2> corners;
  double widest = 0.0;
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const Vec2& next = profile[i];
    widest = std::max(widest, next.y());
    if (!corners.empty()) {
      const Vec2 step = next - corners.back();
      const bool rises = step.x() > 0.0;
      bool bulges = rises;
      if (rises && corners.size() > 1) {
        const Vec2 before = corners.back() - corners[corners.size() - 2];
        bulges = before.x() * step.y() - before.y() * step.x() <= kSameSlope * before.norm() * step.norm();
      }
      if (!bulges) {
        const Vec2 last = corners.back();
        if (corners.size() > 1) bodies.emplace_back(corners);
        corners.assign(1, rises ? last : next);
        if (!rises) continue;
      }
    }
    corners.push_back(next);
  }
  if (corners.size() > 1) bodies.emplace_back(corners);
  if (bodies.empty() && profile.size() > 1) bodies.emplace_back(std::vector<Vec2>{Vec2(profile.front().x(), widest)});
  return bodies;
}

}  // namespace flank
