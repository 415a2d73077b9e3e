#include "flank/pipeline/search/wound_face.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "flank/envelope.h"
#include "flank/geom/face_cut.h"
#include "flank/geom/trim.h"
#include "flank/target.h"

namespace flank::internal {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kLeastTurns = 1.0;
constexpr int kRows = 9;            ///< lines along the screw at which a face is looked at
constexpr int kAlong = 4096;        ///< steps of such a line: 40 a turn of a hundred turns
constexpr double kRowInset = 0.02;  ///< of the width: the outer lines are not on the border itself

/// Signed, about the axis of the screw, from one point to another: -pi to pi.
double angle_between(const SelfMotion& motion, const Vec3& from, const Vec3& to) {
  const Vec3 axis = motion.turn.normalized(), a = axis.cross(from - motion.centre), b = axis.cross(to - motion.centre);
  return std::atan2(axis.dot(a.cross(b)), a.dot(b));
}

/// A trimmed surface, seen along one of its parameters.
struct Lines {
  const BSplineSurface& surface;
  const TrimRegion& region;
  bool along_u = false;

  [[nodiscard]] Vec3 at(double along, double across) const {
    return along_u ? surface.value(along, across) : surface.value(across, along);
  }
  [[nodiscard]] bool inside(double along, double across) const {
    return region.whole() || (along_u ? region.inside(along, across) : region.inside(across, along));
  }
  [[nodiscard]] std::pair<double, double> range(bool along) const {
    const ParameterRectangle& box = region.box();
    return along == along_u ? std::pair(box.u0, box.u1) : std::pair(box.v0, box.v1);
  }
  /// The line of a row, from 0 to kRows - 1.
  [[nodiscard]] double row(int k) const {
    const auto [low, high] = range(false);
    return low + (high - low) * (kRowInset + (1.0 - 2.0 * kRowInset) * k / (kRows - 1));
  }
  [[nodiscard]] double step(int i) const {
    const auto [low, high] = range(true);
    return low + (high - low) * i / kAlong;
  }
};

/// Angles about the axis at the steps of a line, from `begin` in its middle on; they are not cut off at a turn.
std::vector<double> angles_along(const SelfMotion& motion, const Lines& lines, double across, double begin) {
  std::vector<Vec3> points;
  for (int i = 0; i <= kAlong; ++i) points.push_back(lines.at(lines.step(i), across));
  std::vector<double> angles(points.size(), begin);
  for (std::size_t i = kAlong / 2; i < kAlong; ++i)
    angles[i + 1] = angles[i] + angle_between(motion, points[i], points[i + 1]);
  for (std::size_t i = kAlong / 2; i > 0; --i)
    angles[i - 1] = angles[i] + angle_between(motion, points[i], points[i - 1]);
  return angles;
}

/// Does the face turn along one of its middle lines as only one does that may go round an axis? By its tangents, which is
/// cheap: few faces do.
bool may_be_wound(const BSplineSurface& surface, const TrimRegion& region) {
  constexpr int kSteps = 512;
  constexpr double kLeastBend = 2.0;  // radians: a turn of a screw that climbs at 70 degrees
  for (const bool along_u : {true, false}) {
    const Lines lines{surface, region, along_u};
    double bend = 0.0;
    Vec3 before = Vec3::Zero(), tangent = Vec3::Zero();
    for (int i = 0; i <= kSteps; ++i) {
      const Vec3 p = lines.at(lines.step(i * (kAlong / kSteps)), lines.row(kRows / 2));
      const Vec3 next = p - before;
      if (i > 1) bend += std::atan2(tangent.cross(next).norm(), tangent.dot(next));
      before = p;
      tangent = next;
    }
    if (bend > kLeastBend) return true;
  }
  return false;
}

/// The parameter along which the face goes farther round the axis.
bool goes_along_u(const SelfMotion& motion, const BSplineSurface& surface, const TrimRegion& region) {
  const auto swept = [&](bool along_u) {
    const Lines lines{surface, region, along_u};
    const std::vector<double> angles = angles_along(motion, lines, lines.row(kRows / 2), 0.0);
    return std::abs(angles.back() - angles.front());
  };
  return swept(true) > swept(false);
}

/// Fills in the ends of all rows and the half turn.
void measure(const Lines& lines, WoundFace& wound) {
  const double speed = wound.motion.turn.norm();
  constexpr double kNone = std::numeric_limits<double>::infinity();
  wound.first = wound.half_turn[0] = kNone;
  wound.last = wound.half_turn[1] = -kNone;
  for (int k = 0; k < kRows; ++k) {
    const double across = lines.row(k),
                 begin = angle_between(wound.motion, wound.middle, lines.at(lines.step(kAlong / 2), across));
    const std::vector<double> angles = angles_along(wound.motion, lines, across, begin);
    for (int i = 0; i <= kAlong; ++i) {
      const double along = lines.step(i), angle = angles[static_cast<std::size_t>(i)];
      if (k == kRows / 2 && std::abs(angle) <= 0.25 * kTurn) {
        wound.half_turn[0] = std::min(wound.half_turn[0], along);
        wound.half_turn[1] = std::max(wound.half_turn[1], along);
      }
      if (!lines.inside(along, across)) continue;
      wound.first = std::min(wound.first, angle / speed);
      wound.last = std::max(wound.last, angle / speed);
    }
  }
}

/// How far points of the face are from it when the screw has moved them, mm, where they are not past its border.
double leaves_by(const WoundFace& wound, const Lines& lines, const Target& target) {
  constexpr int kTimes = 32;  // a turn
  const double along = lines.step(kAlong / 2), turn = kTurn / wound.motion.turn.norm();
  double most = 0.0;
  for (int k = 1; k + 1 < kRows; ++k) {
    const Vec3 p = lines.at(along, lines.row(k));
    for (double time = wound.first; time <= wound.last; time += turn / kTimes) {
      const Footpoint foot = target.closest(wound.motion.moved(p, time));
      if (foot.location == Location::kInside) most = std::max(most, std::abs(foot.distance));
    }
  }
  return most;
}

/// How deep the flank is in an obstacle, mm; negative: clear. Exactly: cells of interpolated distances are those of the
/// whole face's size, and now and then one of them is wrong where a wall's sign ends.
double depth_at(const Pose& pose, const RadialFunction& tool, const ObstacleField& obstacles) {
  constexpr int kPlaces = 30;
  double deepest = -std::numeric_limits<double>::infinity();
  for (int j = 0; j <= kPlaces; ++j) {
    const double s = tool.axis_length() * j / kPlaces, r = tool.at(s).r;
    deepest = std::max(deepest, r - obstacles.at(pose.at(s), 2.0 * r).distance_mm);
  }
  return deepest;
}

/// First and last time of the places that a motion touches with its middle pose: both 0 beside the middle of the face.
std::pair<double, double> times_of_contact(const WoundFace& wound, const Target& half_turn, const RuledMotion& motion,
                                           const RadialFunction& tool, double tolerance_mm) {
  constexpr int kContacts = 49;
  constexpr double kNear = 4.0;  // tolerances
  double early = std::numeric_limits<double>::infinity(), late = -early;
  const int side = contact_side(motion, tool, -half_turn.closest(wound.middle).normal);
  for (const ContactPoint& contact : characteristic(motion, tool, 0.5, side, kContacts)) {
    const Footpoint foot = half_turn.closest(contact.point);
    const bool near = foot.location == Location::kInside && std::abs(foot.distance) <= kNear * tolerance_mm;
    if (!contact.exists || !near) continue;
    early = std::min(early, wound.time_of(foot.point));
    late = std::max(late, wound.time_of(foot.point));
  }
  if (early > late) early = late = wound.time_of(motion.pose(0.5).at(0.5 * motion.axis_length));
  return {early, late};
}

/// A line that goes with a screw.
struct Carried {
  const SelfMotion& motion;
  const Pose& line;
  const RadialFunction& tool;
  const ObstacleField* obstacles;
  double allowed_mm;  ///< depth in obstacles

  [[nodiscard]] Pose at(double time) const { return {motion.moved(line.tip, time), motion.turned(line.axis, time)}; }
  [[nodiscard]] bool is_free(double time) const {
    return obstacles == nullptr || depth_at(at(time), tool, *obstacles) <= allowed_mm;
  }
  /// The time nearest to `until` up to which, from 0 on, it is free.
  [[nodiscard]] double free_until(double until, double turn) const {
    constexpr int kLooks = 64;          // a turn
    constexpr double kLastStep = 0.02;  // of the first: how closely the end is found
    const double step = turn / kLooks;
    double time = 0.0;
    for (double way = std::copysign(step, until); time != until && std::abs(way) > kLastStep * step;) {
      const double next = std::abs(time + way) < std::abs(until) ? time + way : until;
      if (is_free(next))
        time = next;
      else
        way *= 0.5;
    }
    return time;
  }
};

}  // namespace

double WoundFace::turns() const { return (last - first) * motion.turn.norm() / kTurn; }

double WoundFace::time_of(const Vec3& p) const { return angle_between(motion, middle, p) / motion.turn.norm(); }

std::optional<WoundFace> find_wound_face(const Setup& setup) {
  constexpr double kSamples = 1600.0;  // as for starts
  constexpr double kShare = 0.5;       // of the tolerance
  if (setup.part.is_mesh() || setup.targets.size() != 1) return std::nullopt;
  const Face& face = setup.part.faces[static_cast<std::size_t>(setup.targets.front())];
  const BSplineSurface& s = face.surface;
  const TrimRegion region(face.loops, {s.u_first(), s.u_last(), s.v_first(), s.v_last()});
  if (!may_be_wound(s, region)) return std::nullopt;
  const std::unique_ptr<Target> target = make_target({face}, +1);
  const auto motion = self_motion(target->samples(std::sqrt(target->area() / kSamples)));
  if (!motion || motion->turn.isZero() || motion->slide.isZero()) return std::nullopt;
  WoundFace wound;
  wound.motion = *motion;
  wound.along_u = goes_along_u(*motion, s, region);
  const Lines lines{s, region, wound.along_u};
  wound.middle = lines.at(lines.step(kAlong / 2), lines.row(kRows / 2));
  measure(lines, wound);
  if (!(wound.turns() > kLeastTurns) || !(wound.half_turn[1] > wound.half_turn[0])) return std::nullopt;
  if (leaves_by(wound, lines, *target) > kShare * setup.tolerance_mm) return std::nullopt;
  return wound;
}

Setup half_turn_of(const Setup& setup, const WoundFace& wound) {
  const auto at = static_cast<std::size_t>(setup.targets.front());
  const Face& whole = setup.part.faces[at];
  const auto [low, high] = wound.half_turn;
  Setup half = setup;
  half.part.faces[at] = cut_face(whole, wound.along_u, low, high);
  const BSplineSurface& s = whole.surface;
  const double first = wound.along_u ? s.u_first() : s.v_first(), last = wound.along_u ? s.u_last() : s.v_last();
  for (const auto& [a, b] : {std::pair(first, low), std::pair(high, last)}) {
    half.checks.push_back(static_cast<int>(half.part.faces.size()));
    half.part.faces.push_back(cut_face(whole, wound.along_u, a, b));
    half.part.surface_types.push_back(setup.part.surface_types[at]);
  }
  return half;
}

RuledMotion extend_along_screw(const WoundFace& wound, const Target& half_turn, const ObstacleField* obstacles,
                               const RuledMotion& motion, const RadialFunction& tool, double tolerance_mm) {
  constexpr int kControlPoints = 24, kPoses = 8 * kControlPoints;  // a turn
  constexpr double kPastEnd = 0.03;                                // of a turn
  const Pose line = motion.pose(0.5);
  const auto [early, late] = times_of_contact(wound, half_turn, motion, tool, tolerance_mm);
  const double turn = kTurn / wound.motion.turn.norm();
  const Carried carried{
      wound.motion, line, tool, obstacles,
      obstacles != nullptr ? std::max(obstacles->allowance_mm(), depth_at(line, tool, *obstacles)) : 0.0};
  const double first = carried.free_until(wound.first - late - kPastEnd * turn, turn),
               last = carried.free_until(wound.last - early + kPastEnd * turn, turn);
  const int count = std::max(kPoses, static_cast<int>(std::ceil(kPoses * (last - first) / turn)));
  std::vector<Pose> poses;
  std::vector<double> t;
  for (int i = 0; i <= count; ++i) {
    t.push_back(static_cast<double>(i) / count);
    poses.push_back(carried.at(first + t.back() * (last - first)));
  }
  return fit_motion(poses, t, motion.axis_length, std::max(kControlPoints, count * kControlPoints / kPoses));
}

}  // namespace flank::internal
