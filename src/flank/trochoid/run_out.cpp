#include "flank/trochoid/run_out.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <optional>

namespace flank::internal {
namespace {

/// Deeper than at the end of a side by this share counts as deeper.
constexpr double kMore = 1.1;

/// Mean direction of both ways over their last quarter at an end, along x, across the axis.
Vec3 common_direction(const SidePath& a, const SidePath& b, bool end) {
  constexpr double kShare = 0.25;  // the last velocities of a fitted motion alone may be off
  const double middle = 0.5 * a.axis_length();
  Vec3 sum = Vec3::Zero(), up = Vec3::Zero();
  for (const SidePath* path : {&a, &b}) {
    const double x = end ? path->length() : 0.0, inner = end ? (1.0 - kShare) * x : kShare * path->length();
    const AxisPlace outer = path->at(x);
    const Vec3 way = outer.at(middle) - path->at(inner).at(middle);
    sum += (end ? way : Vec3(-way)).normalized();
    up += outer.u;
  }
  up.normalize();
  return (sum - sum.dot(up) * up).normalized();
}

/// Beyond an end nothing has to be touched, so both axes turn there to one direction: fronts that lead in and out then turn
/// the tool no more than the sides ask for. Where one side begins behind the other, its run-out lies beside the other's
/// face, and it is this one that turns. None where they are less than 20 degrees apart: cycles get through without it, and their
/// way is shorter by some percent.
std::optional<Vec3> common_axis(const SidePath& a, const SidePath& b, bool end) {
  constexpr double kHardly = 0.35;
  const double middle = 0.5 * a.axis_length();
  const AxisPlace p = a.at(end ? a.length() : 0.0), q = b.at(end ? b.length() : 0.0);
  const double angle = std::acos(std::clamp(p.u.dot(q.u), -1.0, 1.0));
  if (angle < kHardly || angle > 0.9 * std::numbers::pi) return {};
  const Vec3 forward = common_direction(a, b, end), gap = q.at(middle) - p.at(middle);
  const double ahead = (end ? -1.0 : 1.0) * -gap.dot(forward), across = (gap - gap.dot(forward) * forward).norm();
  const double share = std::clamp(0.5 + 0.5 * ahead / std::max(across, 1e-9), 0.0, 1.0);
  return (std::sin((1.0 - share) * angle) * p.u + std::sin(share * angle) * q.u) / std::sin(angle);
}

/// How both paths leave one end.
struct Bend {
  Vec3 direction, rise;
  double over_mm = 1.0, rise_over_mm = 1.0;
  std::optional<Vec3> axis = {};
  double turn_over_mm = 1.0;
};

void lay(SidePath& a, SidePath& b, bool end, const Bend& bend) {
  for (SidePath* path : {&a, &b}) {
    path->bend_run_out(end, bend.direction, bend.over_mm);
    path->raise_run_out(end, bend.rise, bend.rise_over_mm);
    path->turn_run_out(end, bend.axis, bend.turn_over_mm);
  }
}

double depth_at(const Pose& pose, const HalfGuard& guard) {
  constexpr int kPlaces = 7;
  GuardDepth depth;
  guard.look(pose, kPlaces, depth);
  return depth.deepest();
}

/// Calls see(pose) along a run-out, up to where cycles begin and end.
template <typename See>
void walk(const SidePath& path, bool end, double radius, const See& see) {
  constexpr double kFarthest = 6.0, kFirst = 0.1, kGrow = 1.25, kStep = 0.4;  // radii: densest at the end
  for (double by = kFirst; by <= kFarthest; by += std::min(kStep, (kGrow - 1.0) * by)) {
    const AxisPlace place = path.at(end ? path.length() + by * radius : -by * radius);
    see(Pose{place.tip, place.u});
  }
}

/// Deepest that a run-out enters a face, mm.
double entered(const SidePath& path, bool end, double radius, const HalfGuard& guard) {
  double deepest = 0.0;
  walk(path, end, radius, [&](const Pose& pose) { deepest = std::max(deepest, depth_at(pose, guard)); });
  return deepest;
}

/// Where a run-out enters a face deeper than that for the first time.
std::optional<Pose> first_entered(const SidePath& path, bool end, double radius, const HalfGuard& guard, double most) {
  std::optional<Pose> found;
  walk(path, end, radius, [&](const Pose& pose) {
    if (!found && depth_at(pose, guard) > most) found = pose;
  });
  return found;
}

double entered_at_end(const SidePath& path, bool end, const HalfGuard& guard) {
  const AxisPlace place = path.at(end ? path.length() : 0.0);
  return depth_at({place.tip, place.u}, guard);
}

/// Unit vector across a way in which a tool leaves what it enters soonest, by central differences of the depth; none where
/// that is back along the way. A face that is met beside the axis, the rim of a hub below a leaning tool say, is hardly left
/// along it.
std::optional<Vec3> way_out(const Pose& pose, const Vec3& way, double radius, const HalfGuard& guard) {
  constexpr double kLeastAcross = 0.5;
  const double step = 0.01 * radius;
  Vec3 gradient;
  for (int k = 0; k < 3; ++k) {
    const Vec3 by = step * Vec3::Unit(k);
    gradient[k] = depth_at({pose.tip + by, pose.axis}, guard) - depth_at({pose.tip - by, pose.axis}, guard);
  }
  if (!(gradient.norm() > 0.0)) return {};
  const Vec3 out = -gradient.normalized(), across = out - out.dot(way) * way;
  if (across.norm() < kLeastAcross) return {};
  return across.normalized();
}

/// Search of one end's bend, from gentle to steep.
class BendSearch {
 public:
  BendSearch(SidePath& a, SidePath& b, bool end, double radius_mm, const HalfGuard& guard, double allowed_mm)
      : a_(a), b_(b), end_(end), radius_(radius_mm), guard_(guard), common_(common_direction(a, b, end)) {
    most_a_ = std::max(allowed_mm, kMore * entered_at_end(a, end, guard));
    most_b_ = std::max(allowed_mm, kMore * entered_at_end(b, end, guard));
  }
  /// Lays the best and says how much deeper than allowed it enters, mm.
  double run() {
    const Vec3 up = (a_.at(end_ ? a_.length() : 0.0).u + b_.at(end_ ? b_.length() : 0.0).u).normalized();
    axis_ = common_axis(a_, b_, end_);
    if (axis_) look_at_rises(up, {1.0, 0.4, 0.1});
    axis_.reset();
    look_at_rises(up, {1.0, 0.4, 0.1});
    if (least_ > 0.0) leave_what_is_entered();
    lay(a_, b_, end_, best_);
    return std::max(0.0, least_);
  }

 private:
  void look(const Vec3& rise, double rise_over, double over) {
    if (least_ <= 0.0) return;
    constexpr double kTurnOver = 4.0;  // radii
    const Bend bend{common_, rise, over * radius_, rise_over * radius_, axis_, kTurnOver * radius_};
    lay(a_, b_, end_, bend);
    const double deep =
        std::max(entered(a_, end_, radius_, guard_) - most_a_, entered(b_, end_, radius_, guard_) - most_b_);
    if (deep >= least_) return;
    least_ = deep;
    best_ = bend;
  }
  /// A floor that rises right behind the end is risen from at once: over the shortest of some lengths, in radii.
  void look_at_rises(const Vec3& up, std::initializer_list<double> lengths) {
    for (const double rise : {0.0, 0.12, 0.25, 0.45, 0.7, 1.0})
      for (const double rise_over : lengths)
        for (const double over : {1.0, 2.0, 4.0})
          if (rise > 0.0 || rise_over == 1.0) look(rise * up, rise_over, over);
  }
  void leave_what_is_entered() {
    lay(a_, b_, end_, {common_, Vec3::Zero(), radius_, radius_, {}, radius_});
    std::optional<Pose> place = first_entered(a_, end_, radius_, guard_, most_a_);
    if (!place) place = first_entered(b_, end_, radius_, guard_, most_b_);
    if (!place) return;
    if (const std::optional<Vec3> out = way_out(*place, common_, radius_, guard_))
      look_at_rises(*out, {1.0, 0.4, 0.1, 0.03});
  }

  SidePath &a_, &b_;
  bool end_;
  double radius_;
  const HalfGuard& guard_;
  Vec3 common_;
  double most_a_, most_b_;
  std::optional<Vec3> axis_;
  Bend best_;
  double least_ = std::numeric_limits<double>::infinity();
};

}  // namespace

void join_run_outs(SidePath& a, SidePath& b, double radius_mm) {
  for (const bool end : {false, true})
    lay(a, b, end, {common_direction(a, b, end), Vec3::Zero(), radius_mm, radius_mm, {}, radius_mm});
}

RunOutDepth join_run_outs(SidePath& a, SidePath& b, double radius_mm, const HalfGuard& guard, double allowed_mm) {
  RunOutDepth depth;
  depth.start = BendSearch(a, b, false, radius_mm, guard, allowed_mm).run();
  depth.end = BendSearch(a, b, true, radius_mm, guard, allowed_mm).run();
  return depth;
}

double free_run_out(const SidePath& path, bool end, double most_mm, const HalfGuard& guard, double allowed_mm) {
  // What a run-out enters, it enters within a fraction of a radius: the tool rounds an edge there.
  constexpr int kSteps = 60, kPlaces = 13;
  const double allowed = std::max(allowed_mm, kMore * entered_at_end(path, end, guard));
  for (int k = 1; k <= kSteps; ++k) {
    const double by = most_mm * k / kSteps;
    const AxisPlace place = path.at(end ? path.length() + by : -by);
    GuardDepth depth;
    guard.look({place.tip, place.u}, kPlaces, depth);
    if (depth.deepest() > allowed) return most_mm * (k - 1) / kSteps;
  }
  return most_mm;
}

}  // namespace flank::internal
