#include "flank/obstacle/convex_profile.h"

#include <algorithm>
#include <cmath>

#include "flank/base/assert.h"

namespace flank::internal {
namespace {

/// Sine of the angle up to which two sides count as one line: a corner that round-off bends inwards must not split a
/// body.
constexpr double kSameSlope = 1e-12;

/// Plain, because millimetres neither overflow nor vanish; std::hypot guards against both and costs a tenth of a query.
double length_of(double x, double y) { return std::sqrt(x * x + y * y); }

}  // namespace

ConvexProfile::ConvexProfile(const std::vector<Vec2>& corners, double rounding)
    : first_(corners.front()), rounding_(rounding) {
  FLANK_ASSERT(!corners.empty() && rounding >= 0.0);
  // The outline is closed over the axis, so that both ends are faces of the body.
  Vec2 at(corners.front().x(), 0.0);
  const auto add = [&](const Vec2& to) {
    const Vec2 step = to - at;
    const double length = step.norm();
    if (length > 0.0) {
      const double nz = -step.y() / length, nr = step.x() / length;
      sides_.push_back({nz, nr, nz * at.x() + nr * at.y(), nr * at.x() - nz * at.y(), length});
    }
    at = to;
  };
  for (const Vec2& corner : corners) add(corner);
  add({corners.back().x(), 0.0});
}

ProfileJet ConvexProfile::at(double z, double rho) const {
  if (sides_.empty()) {
    const double d = length_of(z - first_.x(), rho);
    if (!(d > 0.0)) return {-rounding_, 0.0, 1.0, 0.0};
    return {d - rounding_, (z - first_.x()) / d, rho / d, 1.0 / d};
  }
  // Inside, the distance is that to the nearest side's line; outside, that side is where the search for the foot
  // begins.
  std::size_t k = 0;
  double farthest = -1e300;
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    const double out = sides_[i].normal_z * z + sides_[i].normal_rho * rho - sides_[i].offset;
    if (out > farthest) farthest = out, k = i;
  }
  const auto share = [&](std::size_t i) {
    return sides_[i].normal_rho * z - sides_[i].normal_z * rho - sides_[i].start;
  };
  double t = share(k);
  // A disc without thickness has no inside: a point of its plane is as far from it as from its rim.
  const bool is_disc = sides_.size() == 2 && sides_[0].normal_rho == 0.0 && sides_[1].normal_rho == 0.0;
  if ((farthest <= 0.0 && !is_disc) || (t >= 0.0 && t <= sides_[k].length))
    return {farthest - rounding_, sides_[k].normal_z, sides_[k].normal_rho, 0.0};
  // Outside: from the side that faces the point most to the one that holds its foot.
  while (t < 0.0 && k > 0 && share(k - 1) <= sides_[k - 1].length) t = share(--k);
  while (t > sides_[k].length && k + 1 < sides_.size() && share(k + 1) >= 0.0) t = share(++k);
  const Side& side = sides_[k];
  const double off = side.normal_z * z + side.normal_rho * rho - side.offset;
  const double past = t - std::clamp(t, 0.0, side.length);
  const double d = length_of(off, past);
  if (!(d > 0.0)) return {-rounding_, side.normal_z, side.normal_rho, 0.0};
  return {d - rounding_, (off * side.normal_z + past * side.normal_rho) / d,
          (off * side.normal_rho - past * side.normal_z) / d, past == 0.0 ? 0.0 : 1.0 / d};
}

BodyJet body_jet(const ConvexProfile& body, const Pose& pose, const Vec3& x) {
  const PosedPoint at(pose, x);
  BodyJet jet{body.at(at.z, at.rho)};
  jet.z = at.z;
  jet.rho = at.rho;
  jet.across = at.rho > 0.0 ? Vec3(at.perpendicular / at.rho) : pose.axis.unitOrthogonal();
  jet.gradient = jet.along * pose.axis + jet.out * jet.across;
  return jet;
}

std::vector<ConvexProfile> split_convex(const std::vector<Vec2>& profile) {
  std::vector<ConvexProfile> bodies;
  std::vector<Vec2> corners;
  // A body ends where the outline turns inwards or jumps: a step down in z, or a slope that grows.
  double widest = 0.0;
  for (const Vec2& next : profile) {
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
  // A profile without length is a disc.
  if (bodies.empty() && profile.size() > 1) bodies.emplace_back(std::vector<Vec2>{Vec2(profile.front().x(), widest)});
  return bodies;
}

}  // namespace flank::internal
