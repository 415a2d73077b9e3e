#include "flank/wheel/point/tip_room.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "flank/wheel/point/axis_rod.h"

namespace flank::internal {
namespace {

constexpr double kHeightShare = 0.1;  ///< of the tolerance: so far above what it touches the sphere stays
constexpr double kHorizonMm = 1.0;    ///< farther rooms are not told apart
constexpr double kStepMm = 0.4;       ///< along the axis, at least
constexpr double kSlowest =
    0.7;  ///< millimetres along the axis, at least, that a millimetre of room lasts: cones of up to 20 degrees
constexpr double kGapPerMm = 0.08;       ///< of the axis: a direction is to leave so much more room higher up
constexpr double kTrianglesOffMm = 0.1;  ///< more than triangles are off their faces
constexpr double kRodLookMm = 8.0;       ///< so far the wheel is looked for beside the rod
constexpr int kDrops = 12;
constexpr double kNotHeldMm = -10.0;  ///< room of a direction that no machine holds

/// Beside the border of a face a footpoint has no side, and from behind a thin blade its far face looks away: the distance alone counts.
/// A tool that enters something crosses its surface somewhere.
double height_of(const Footpoint& foot) { return std::abs(foot.distance); }

}  // namespace

Footpoint nearest_foot(const std::vector<const Target*>& targets, const Vec3& p, double horizon_mm) {
  Footpoint best;
  double least = horizon_mm;
  for (const Target* target : targets) {
    if (target->box().squared_distance(p) >= least * least) continue;
    const Footpoint foot = target->closest_within(p, least);
    if (foot.patch >= 0 && std::abs(foot.distance) < least) least = std::abs(foot.distance), best = foot;
  }
  return best;
}

TipRoom::TipRoom(const FloorChannel& channel, const RadialFunction& radial, const PointOptions& options)
    : channel_(channel),
      radial_(radial),
      tip_mm_(radial.at(0.0).r),
      lift_mm_(tip_mm_ + kHeightShare * options.tolerance_mm + options.height_mm),
      enter_mm_(options.enter_share * options.tolerance_mm),
      length_(radial.axis_length()),
      above_(length_ + 2.0 * radial.at(length_).r),
      rod_from_(length_ + options.shank_mm),
      rod_mm_(rod_radius(options.shank_mm, channel.reach_mm, RodRoom::kPlanned)),
      held_(options.held) {}

std::optional<TipRoom::Rest> TipRoom::rest(const Vec3& p) const {
  Vec3 at = p;
  for (int k = 0; k < kDrops; ++k) {
    const Footpoint foot = nearest_foot(channel_.floor, at, std::numeric_limits<double>::infinity());
    if (foot.patch < 0) return {};
    const Vec3 next = foot.point + lift_mm_ * foot.normal;
    const double moved = (next - at).norm();
    at = next;
    // On a floor that bends the nearest place is another one from up there.
    if (moved < 1e-4 * lift_mm_ || k > 2)
      return foot.location == Location::kInside ? std::optional(Rest{at, foot.normal, foot.k1}) : std::nullopt;
  }
  return {};
}

bool TipRoom::tip_is_free(const Vec3& center, double deeper_mm) const {
  const Footpoint foot = nearest_foot(channel_.walls, center, tip_mm_ + kHorizonMm);
  return foot.patch < 0 || height_of(foot) - tip_mm_ >= -enter_mm_ - deeper_mm;
}

double TipRoom::rod_room(const Pose& pose, double most) const {
  double least = most;
  if (channel_.wheel == nullptr) return least;
  // The rod is long and the wheel seldom near: how far exactly is not asked beyond a few millimetres.
  const double look = rod_mm_ + std::max(most, kRodLookMm);
  for (double s = rod_from_; s <= length_ + channel_.reach_mm;) {
    const Vec3 p = pose.at(s);
    if (channel_.wheel_distances != nullptr) {
      const double gap = channel_.wheel_distances->at_least(p) - rod_mm_;
      if (gap > kStepMm) {
        s += gap;
        continue;
      }
    }
    const double gap = std::sqrt(channel_.wheel->closest_within(p, look).squared_distance) - rod_mm_;
    least = std::min(least, gap);
    if (least < 0.0) return least;
    s += std::max(kStepMm, gap);
  }
  return least;
}

double TipRoom::room(const Pose& pose, double enter_mm) const {
  double least = kHorizonMm;
  for (double s = 0.0; s <= above_;) {
    const double r = radius(s);
    const Vec3 p = pose.at(s);
    if (s > 0.0 && channel_.distances != nullptr) {
      const double gap = channel_.distances->at_least(p) - r - kTrianglesOffMm;
      if (gap > kStepMm && gap >= -enter_mm) {
        least = std::min(least, gap);
        s += std::max(kStepMm, 0.5 * gap);
        continue;
      }
    }
    if (s > 0.0 && channel_.coarse != nullptr) {
      const double gap = std::sqrt(channel_.coarse->closest(p).squared_distance) - r - kTrianglesOffMm;
      // What is to keep off by more than triangles are off their faces is settled by them, too.
      if (gap > 0.0 || gap + 2.0 * kTrianglesOffMm < -enter_mm) {
        least = std::min(least, gap);
        if (least < -enter_mm) return least;
        s += std::max(kStepMm, 0.5 * gap);
        continue;
      }
    }
    double gap = kHorizonMm;
    const Footpoint wall = nearest_foot(channel_.walls, p, r + kHorizonMm);
    if (wall.patch >= 0) gap = std::min(gap, height_of(wall) - r);
    if (s > 0.0) {
      const Footpoint floor = nearest_foot(channel_.floor, p, r + kHorizonMm);
      if (floor.patch >= 0) gap = std::min(gap, height_of(floor) - r);
    }
    least = std::min(least, gap);
    if (least < -enter_mm) return least;
    s += std::max(kStepMm, 0.5 * gap);
  }
  const double rod = rod_room(pose, kHorizonMm);
  return rod < 0.0 ? std::min(rod - kHorizonMm, least) : least;
}

double TipRoom::rough_room(const Pose& pose, double least) const {
  if (!held_.holds(pose.axis)) return kNotHeldMm;
  double best = kEnoughMm;
  for (double s = kStepMm; s <= above_;) {
    const double r = radius(s), wanted = std::min(kEnoughMm, kGapPerMm * s);
    const Vec3 p = pose.at(s);
    const double gap = (channel_.distances != nullptr ? channel_.distances->at(p)
                                                      : std::sqrt(channel_.coarse->closest(p).squared_distance)) -
                       r;
    best = std::min(best, gap + kEnoughMm - wanted);
    if (best <= least) return best;
    // Nothing that is farther than the least one found so far can be below it on the next so many millimetres.
    s += std::max(kStepMm, kSlowest * (gap + kEnoughMm - wanted - best));
  }
  // A rod with room lacks nothing.
  const double rod = rod_room(pose, kEnoughMm);
  return rod < 0.0 ? std::min(best, rod - kEnoughMm) : best;
}

}  // namespace flank::internal
