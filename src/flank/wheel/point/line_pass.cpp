#include "flank/wheel/point/line_pass.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace flank::internal {
namespace {

constexpr double kLeastMm = 0.01;  ///< poses that are nearer to each other are one
constexpr int kHalvings = 8;       ///< of the search for the end of a pass's room

/// Where a tip stands at a place.
struct Stand {
  Vec3 tip, normal;
  double deeper_mm;
};

/// None beside the face, and where the tip alone has no room.
std::optional<Stand> stand_at(const LineWork& work, std::size_t line, double place) {
  const std::optional<FaceLines::Place> here = work.lines.at(line, place);
  if (!here) return {};
  const FlankJoints::Shift joint = work.joints.at(line, place, *here);
  const Stand out{here->point + work.room.lift_mm() * here->normal + joint.moved, here->normal, joint.deeper_mm};
  return work.room.tip_is_free(out.tip, out.deeper_mm) ? std::optional(out) : std::nullopt;
}

std::optional<Pose> nearest_to(const LineWork& work, const Stand& stand, const Vec3& wish) {
  const auto own = AxisField::nearest_free(work.room, {stand.tip, stand.normal, 0.0}, wish, stand.deeper_mm);
  return own ? std::optional(Pose{stand.tip, *own}) : std::nullopt;
}

/// A pose with room at a place; none where no direction has any. `beside`: a pose of the same pass, null: none.
std::optional<Pose> pose_at(const LineWork& work, std::size_t line, double place, const Pose* beside) {
  const std::optional<Stand> stand = stand_at(work, line, place);
  if (!stand) return {};
  const double row = place / work.rows_apart, column = static_cast<double>(line) / work.columns_apart;
  const Pose smooth{stand->tip, work.field.at(row, column)};
  if (work.room.is_free(smooth, stand->deeper_mm)) return smooth;
  for (const Vec3& axis : work.field.around(row, column))
    if (const Pose pose{stand->tip, axis}; work.room.is_free(pose, stand->deeper_mm)) return pose;
  // A place smaller than the net's cells, as beside the foot of a post.
  if (beside != nullptr)
    if (const Pose pose{stand->tip, beside->axis}; work.room.is_free(pose, stand->deeper_mm)) return pose;
  return nearest_to(work, *stand, beside != nullptr ? beside->axis : smooth.axis);
}

/// The same; where the axis would have to jump to it from the pose beside, only so far to it as it may turn, if that has room.
std::optional<Pose> pose_beside(const LineWork& work, std::size_t line, double place, const Pose* beside) {
  const std::optional<Pose> pose = pose_at(work, line, place, beside);
  if (!pose || beside == nullptr || work.goes_on(*beside, *pose)) return pose;
  constexpr double kShare = 0.9;
  const Vec3 across = (pose->axis - beside->axis.dot(pose->axis) * beside->axis).normalized();
  const double angle = kShare * work.most_turn_rad;
  const Pose turned{pose->tip, std::cos(angle) * beside->axis + std::sin(angle) * across};
  const std::optional<Stand> stand = stand_at(work, line, place);
  return stand && work.room.is_free(turned, stand->deeper_mm) ? turned : *pose;
}

struct Placed {
  Pose pose;
  double place;
};

/// The last pose with room, and no other axis, from a place that has it to one that has none.
Placed last_with_room(const LineWork& work, std::size_t line, Placed good, double bad) {
  for (int k = 0; k < kHalvings; ++k) {
    const double middle = 0.5 * (good.place + bad);
    const std::optional<Pose> there = pose_beside(work, line, middle, &good.pose);
    if (there && work.goes_on(good.pose, *there))
      good = {*there, middle};
    else
      bad = middle;
  }
  return good;
}

/// An axis between those of two poses, by the way; where that has no room, the nearest one that has.
std::optional<Pose> pose_between(const LineWork& work, std::size_t line, double place, const Placed& a,
                                 const Placed& b) {
  const std::optional<Stand> stand = stand_at(work, line, place);
  if (!stand) return {};
  const double t = (place - a.place) / (b.place - a.place);
  const Pose even{stand->tip, ((1.0 - t) * a.pose.axis + t * b.pose.axis).normalized()};
  // A little deeper than where directions are chosen: between two that have room there is little that has none, and the whole motion is proved.
  if (work.room.is_free(even, stand->deeper_mm + std::max(0.0, work.room.enter_mm()))) return even;
  return nearest_to(work, *stand, even.axis);
}

/// Stretches as they grow, pose by pose.
class Stretches {
 public:
  explicit Stretches(std::vector<LineStretch>& out) : out_(out) {}
  void add(const Placed& at) {
    if (open_ && (at.pose.tip - out_.back().poses.back().tip).norm() <= kLeastMm) return;
    if (!open_) out_.emplace_back();
    open_ = true;
    out_.back().poses.push_back(at.pose);
    out_.back().places.push_back(at.place);
  }
  void end() { open_ = false; }

 private:
  std::vector<LineStretch>& out_;
  bool open_ = false;
};

}  // namespace

bool LineWork::goes_on(const Pose& a, const Pose& b) const { return a.axis.dot(b.axis) > std::cos(most_turn_rad); }

std::vector<LineStretch> line_stretches(const LineWork& work, std::size_t line, const std::vector<char>& wanted) {
  std::vector<LineStretch> out;
  Stretches stretches(out);
  std::optional<Placed> last;
  for (std::size_t k = 0; k < wanted.size(); ++k) {
    const double place = static_cast<double>(k);
    std::optional<Placed> here;
    if (wanted[k] != 0)
      if (const auto pose = pose_beside(work, line, place, last ? &last->pose : nullptr)) here = Placed{*pose, place};
    const bool goes_on = last && here && work.goes_on(last->pose, here->pose);
    const bool between = k > 0 && wanted[k] != 0 && wanted[k - 1] != 0;
    if (!goes_on) {
      if (between && last) stretches.add(last_with_room(work, line, *last, place));
      stretches.end();
      if (between && here) stretches.add(last_with_room(work, line, *here, place - 1.0));
    }
    if (here) stretches.add(*here);
    last = here;
  }
  return out;
}

bool has_room(const LineWork& work, std::size_t line, double place, const Pose& pose) {
  const std::optional<Stand> stand = stand_at(work, line, place);
  return stand && work.room.is_free(pose, stand->deeper_mm);
}

std::vector<std::vector<Pose>> with_stops(const LineWork& work, std::size_t line, const LineStretch& stretch) {
  const std::vector<double> stops = work.joints.stops(line);
  std::vector<std::vector<Pose>> out(1, std::vector<Pose>{stretch.poses.front()});
  for (std::size_t k = 0; k + 1 < stretch.poses.size(); ++k) {
    const Placed a{stretch.poses[k], stretch.places[k]}, b{stretch.poses[k + 1], stretch.places[k + 1]};
    auto stop = std::upper_bound(stops.begin(), stops.end(), a.place);
    for (; stop != stops.end() && *stop < b.place; ++stop) {
      const std::optional<Pose> pose = pose_between(work, line, *stop, a, b);
      if (pose)
        out.back().push_back(*pose);
      else if (!out.back().empty())
        out.emplace_back();
    }
    out.back().push_back(b.pose);
  }
  return out;
}

}  // namespace flank::internal
