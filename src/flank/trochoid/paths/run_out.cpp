#include "flank/trochoid/paths/run_out.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

namespace flank::internal {
namespace {

/// Deeper than at the end of a side by this share counts as deeper.
constexpr double kMore = 1.1;
constexpr double kForever = std::numeric_limits<double>::infinity();

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
  double over_mm = 1.0, rise_over_mm = 1.0, rise_until_mm = kForever;
  std::optional<Vec3> axis = {};
  double turn_over_mm = 1.0;
  Vec3 inwards = Vec3::Zero();  ///< of the first path, as it rises; the second one goes the other way
};

void lay(SidePath& a, SidePath& b, bool end, const Bend& bend) {
  for (SidePath* path : {&a, &b}) {
    const Vec3 inwards = path == &a ? bend.inwards : Vec3(-bend.inwards);
    path->bend_run_out(end, bend.direction, bend.over_mm);
    path->raise_run_out(end, bend.rise + inwards, bend.rise_over_mm, bend.rise_until_mm);
    path->turn_run_out(end, bend.axis, bend.turn_over_mm);
  }
}

/// From the first path to the second one at an end, across the way and the axis.
Vec3 across_of(const SidePath& a, const SidePath& b, bool end, const Vec3& direction, const Vec3& up) {
  const double middle = 0.5 * a.axis_length();
  const Vec3 gap = b.at(end ? b.length() : 0.0).at(middle) - a.at(end ? a.length() : 0.0).at(middle);
  const Vec3 across = direction.cross(up).normalized();
  return across.dot(gap) < 0.0 ? Vec3(-across) : across;
}

/// How steeply a run-out rises, and for how many radii.
struct Rise {
  double slope, until;
};

/// From gentle to steep, and level again as soon as that does: fronts between run-outs that go on rising leave what lies
/// below them on the floor.
constexpr std::array<Rise, 16> kRises = {{{0.0, kForever},
                                          {0.12, 0.5},
                                          {0.12, 1.0},
                                          {0.12, kForever},
                                          {0.25, 0.5},
                                          {0.25, 1.0},
                                          {0.25, kForever},
                                          {0.45, 0.5},
                                          {0.45, 1.0},
                                          {0.45, kForever},
                                          {0.7, 0.5},
                                          {0.7, 1.0},
                                          {0.7, kForever},
                                          {1.0, 0.5},
                                          {1.0, 1.0},
                                          {1.0, kForever}}};

/// How far a run-out goes on: six radii past where the other side has its end, which may be far ahead (a splitter's), mm.
double farthest(const SidePath& path, const SidePath& other, bool end, const Vec3& direction, double radius) {
  constexpr double kPast = 6.0;  // radii
  const double middle = 0.5 * path.axis_length();
  const Vec3 here = path.at(end ? path.length() : 0.0).at(middle),
             there = other.at(end ? other.length() : 0.0).at(middle);
  return kPast * radius + std::max(0.0, (end ? 1.0 : -1.0) * (there - here).dot(direction));
}

/// How deep run-outs of one side at one end enter faces, up to where cycles begin and end. Many ways to lay one are tried, and what
/// spoils one mostly spoils the next: it is asked there first.
class RunOutLook {
 public:
  RunOutLook(const SidePath& path, bool end, double radius, double farthest_mm, const HalfGuard& guard)
      : path_(path), end_(end), radius_(radius), farthest_(farthest_mm), guard_(guard) {}

  /// The deepest, mm, of the run-out as it is laid now; where that is `enough` or more, the first place that shows it is all that
  /// is looked at.
  double deepest(double enough) {
    GuardDepth depth;
    look(worst_, depth);
    double most = depth.deepest();
    for (double by = kFirst; by * radius_ <= farthest_ && most < enough; by = next(by)) {
      look(by, depth);
      if (depth.deepest() > most) most = depth.deepest(), worst_ = by;
    }
    return most;
  }
  /// How far it goes before it enters a face deeper than `most`, mm.
  double free(double most) const {
    GuardDepth depth;
    double before = 0.0;
    for (double by = kFirst; by * radius_ <= farthest_; before = by, by = next(by)) {
      look(by, depth);
      if (depth.deepest() > most) return before * radius_;
    }
    return farthest_;
  }

 private:
  static constexpr double kFirst = 0.1, kGrow = 1.25, kStep = 0.4;  // radii: densest at the end
  static double next(double by) { return by + std::min(kStep, (kGrow - 1.0) * by); }
  void look(double by, GuardDepth& depth) const {
    constexpr int kPlaces = 7;
    if (by * radius_ > farthest_) return;
    const AxisPlace place = path_.at(end_ ? path_.length() + by * radius_ : -by * radius_);
    guard_.look({place.tip, place.u}, kPlaces, depth);
  }

  const SidePath& path_;
  bool end_;
  double radius_, farthest_;
  const HalfGuard& guard_;
  double worst_ = 0.1;  ///< radii beyond the end
};

double entered_at_end(const SidePath& path, bool end, const HalfGuard& guard) {
  constexpr int kPlaces = 7;
  GuardDepth depth;
  const AxisPlace place = path.at(end ? path.length() : 0.0);
  guard.look({place.tip, place.u}, kPlaces, depth);
  return depth.deepest();
}

/// Both run-outs at one end: of all ways to lay them the one that enters least.
class RunOutChoice {
 public:
  RunOutChoice(SidePath& a, SidePath& b, bool end, double radius, const HalfGuard& guard, double allowed)
      : a_(a),
        b_(b),
        end_(end),
        radius_(radius),
        common_(common_direction(a, b, end)),
        up_((a.at(end ? a.length() : 0.0).u + b.at(end ? b.length() : 0.0).u).normalized()),
        most_a_(std::max(allowed, kMore * entered_at_end(a, end, guard))),
        most_b_(std::max(allowed, kMore * entered_at_end(b, end, guard))),
        of_a_(a, end, radius, farthest(a, b, end, common_, radius), guard),
        of_b_(b, end, radius, farthest(b, a, end, common_, radius), guard) {}

  /// Lays it, and how deep it enters faces beyond what is allowed, mm.
  double lay_best() {
    const std::optional<Vec3> axis = common_axis(a_, b_, end_);
    if (axis) for_each(common_, axis, [&](const Bend& bend) { keep_shallowest(bend); });
    for_each(common_, {}, [&](const Bend& bend) { keep_shallowest(bend); });
    if (least_ > 0.0) step_inwards(axis);
    if (least_ > kWall * radius_) turn_aside(axis);
    lay(a_, b_, end_, best_);
    return std::max(0.0, least_);
  }
  [[nodiscard]] double free_mm() const { return free_; }

 private:
  /// From gentle to steep. A floor that rises right behind the end is risen from at once.
  template <class Use>
  void for_each(const Vec3& direction, const std::optional<Vec3>& axis, const Use& use) const {
    constexpr double kTurnOver = 4.0;  // radii
    for (const Rise& rise : kRises)
      for (const double rise_over : {1.0, 0.4, 0.1})
        for (const double over : {1.0, 2.0, 4.0})
          if (rise.slope > 0.0 || rise_over == 1.0)
            use({direction, rise.slope * up_, over * radius_, rise_over * radius_, rise.until * radius_, axis,
                 kTurnOver * radius_});
  }
  void keep_shallowest(const Bend& bend) {
    if (least_ <= 0.0) return;
    lay(a_, b_, end_, bend);
    const double deep_a = of_a_.deepest(least_ + most_a_) - most_a_;
    if (deep_a >= least_) return;
    const double deep = std::max(deep_a, of_b_.deepest(least_ + most_b_) - most_b_);
    if (deep >= least_) return;
    least_ = deep;
    best_ = bend;
  }
  /// Forwards, that is: before a wall across the way nothing is gained by turning along it.
  void keep_farthest(const Bend& bend) {
    constexpr double kFarther = 1.1;
    lay(a_, b_, end_, bend);
    const double free = std::min(of_a_.free(most_a_), of_b_.free(most_b_));
    const double forward = free * bend.direction.dot(common_);
    if (!(forward > kFarther * farthest_)) return;
    free_ = free, farthest_ = forward;
    best_ = bend;
  }
  /// Where a side goes on past the end of its path, at some height, what goes straight on from there enters it: both step off their
  /// sides, towards each other, by as little as it takes, and go on side by side.
  void step_inwards(const std::optional<Vec3>& axis) {
    constexpr double kTurnOver = 4.0;  // radii, as the ways below
    const Vec3 across = across_of(a_, b_, end_, common_, up_);
    for (const double until : {0.5, 1.0})
      for (const double slope : {0.06, 0.12, 0.25, 0.45})
        for (const double rise : {0.0, 0.12, 0.25})
          for (const double rise_over : {1.0, 0.4, 0.1})
            for (const double over : {1.0, 2.0, 4.0})
              keep_shallowest({common_, rise * up_, over * radius_, rise_over * radius_, until * radius_, axis,
                               kTurnOver * radius_, slope * across});
  }
  /// Straight on there is a wall: curved sides are gone on along as they bend, or as far as there is room.
  void turn_aside(const std::optional<Vec3>& axis) {
    std::vector<Vec3> directions = {common_};
    for (const double degrees : {15.0, -15.0, 30.0, -30.0, 45.0, -45.0})
      directions.push_back(Eigen::AngleAxisd(degrees * std::numbers::pi / 180.0, up_) * common_);
    for (std::size_t k = 1; k < directions.size(); ++k)
      for_each(directions[k], axis, [&](const Bend& bend) { keep_shallowest(bend); });
    if (least_ <= kWall * radius_) return;
    free_ = 0.0;
    for (const Vec3& direction : directions) for_each(direction, axis, [&](const Bend& bend) { keep_farthest(bend); });
  }

  SidePath &a_, &b_;
  bool end_;
  double radius_;
  Vec3 common_, up_;
  double most_a_, most_b_;
  RunOutLook of_a_, of_b_;
  Bend best_;
  double least_ = kForever, free_ = kForever, farthest_ = 0.0;
};

}  // namespace

void join_run_outs(SidePath& a, SidePath& b, double radius_mm) {
  for (const bool end : {false, true})
    lay(a, b, end, {common_direction(a, b, end), Vec3::Zero(), radius_mm, radius_mm, kForever, {}, radius_mm});
}

RunOutDepth join_run_outs(SidePath& a, SidePath& b, double radius_mm, const HalfGuard& guard, double allowed_mm) {
  RunOutDepth depth;
  for (const bool end : {false, true}) {
    RunOutChoice choice(a, b, end, radius_mm, guard, allowed_mm);
    (end ? depth.end : depth.start) = choice.lay_best();
    (end ? depth.free_end : depth.free_start) = choice.free_mm();
  }
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

double way_to_wall(const SidePath& path, double free_mm, double radius_mm, const HalfGuard& guard,
                   const WallDepths& allowed) {
  // An edge that the tool rounds on its way is not stepped over.
  constexpr int kSteps = 50, kBisections = 12, kPlaces = 13;
  const auto entered = [&](double by) {
    const AxisPlace place = path.at(path.length() + by);
    GuardDepth depth;
    guard.look({place.tip, place.u}, kPlaces, depth);
    return depth;
  };
  const GuardDepth end = entered(0.0);
  const double others = std::max(allowed.wall_mm, kMore * end.others),
               sides = std::max(allowed.side_mm, kMore * end.sides);
  const auto enters = [&](double by) {
    const GuardDepth depth = entered(by);
    return depth.others > others || depth.sides > sides;
  };
  double low = free_mm;
  for (int k = 1; k <= kSteps; ++k) {
    double high = free_mm + radius_mm * k / kSteps;
    if (!enters(high)) {
      low = high;
      continue;
    }
    for (int n = 0; n < kBisections; ++n) {
      const double middle = 0.5 * (low + high);
      (enters(middle) ? high : low) = middle;
    }
    return low;
  }
  // No wall is there: what was known stays.
  return free_mm;
}

}  // namespace flank::internal
