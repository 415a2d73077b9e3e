#include "flank/machine/body_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace flank::internal {
namespace {

/// Distances are not told apart beyond this, mm: it saves looks while solids are far from each other.
constexpr double kFarMm = 200.0;

/// Two solids on a track.
class Pair {
 public:
  Pair(const Machine& machine, const Kinematics& kinematics, const SolidBody& standing, const SolidBody& moving,
       std::span<const JointValues> track, double required)
      : kinematics_(kinematics),
        standing_(standing),
        moving_(moving),
        track_(track),
        required_(std::max(required, kBodyErrorMm)) {
    find_levers(machine);
  }

  std::optional<BodyHit> run() const {
    if (track_.empty()) return std::nullopt;
    double room = room_at(track_[0]);  // what the distance is above what is required, at least
    if (room < 0.0) return hit(0, track_[0]);
    for (std::size_t k = 1; k < track_.size(); ++k) {
      const double way = motion(track_[k - 1], track_[k]);
      if (room < way) room = room_at(track_[k - 1]);
      if (room >= way) {
        room -= way;
        continue;
      }
      if (const auto at = search(track_[k - 1], track_[k], way)) return hit(k, *at);
      room = 0.0;
    }
    return std::nullopt;
  }

 private:
  /// By how much a point of the moving solid moves at most, seen from the standing one, for each unit of a joint between
  /// them: going down the chain a ball holds all places of the solid.
  void find_levers(const Machine& machine) {
    Vec3 middle = moving_.middle();
    double radius = moving_.reach();
    for (std::size_t k = moving_.link(); k-- > standing_.link();) {
      const Joint& joint = machine.joints[k];
      double low = 0.0, high = 0.0;
      for (const JointValues& q : track_) {
        low = std::min(low, q[k]);
        high = std::max(high, q[k]);
      }
      if (joint.kind == JointKind::kLinear) {
        lever_[k] = 1.0;
        radius += std::max(high, -low);
        continue;
      }
      const Vec3 foot = joint.point + joint.direction.dot(middle - joint.point) * joint.direction;
      radius += (middle - foot).norm();
      middle = foot;
      lever_[k] = radius;
    }
  }

  double motion(const JointValues& from, const JointValues& to) const {
    double way = 0.0;
    for (std::size_t k = standing_.link(); k < moving_.link(); ++k) way += lever_[k] * std::abs(to[k] - from[k]);
    return way;
  }

  double room_at(const JointValues& q) const {
    const Eigen::Isometry3d to_standing =
        kinematics_.link(q, standing_.link()).inverse() * kinematics_.link(q, moving_.link());
    return standing_.gap(moving_, to_standing, required_ + kFarMm) - required_;
  }

  /// The first place of a way, which moves the solid by `way` at most, where the two are too near; none if they are not.
  std::optional<JointValues> search(const JointValues& from, const JointValues& to, double way) const {
    JointValues middle{};
    for (std::size_t k = 0; k < kJointCount; ++k) middle[k] = 0.5 * (from[k] + to[k]);
    const double room = room_at(middle);
    if (room >= 0.5 * way) return std::nullopt;
    if (way <= kBodyErrorMm) return room < 0.0 ? std::optional(middle) : std::nullopt;
    if (const auto first = search(from, middle, 0.5 * way)) return first;
    return search(middle, to, 0.5 * way);
  }

  BodyHit hit(std::size_t place, const JointValues& q) const {
    return {moving_.name(), standing_.name(), std::max(0.0, room_at(q) + required_), place, q};
  }

  const Kinematics& kinematics_;
  const SolidBody &standing_, &moving_;
  std::span<const JointValues> track_;
  double required_;
  JointValues lever_{};
};

}  // namespace

std::vector<SolidBody> machine_solids(const Machine& machine) {
  std::vector<SolidBody> solids;
  for (const MachineBody& b : machine.bodies)
    solids.emplace_back(
        b.name, SolidKind::kMachine, b.link,
        std::vector{b.shape == MachineBody::Shape::kBox ? ConvexShape::box(b.from, b.to)
                                                        : ConvexShape::frustum(b.from, b.radius, b.to, b.radius)});
  return solids;
}

std::vector<BodyHit> check_bodies(const Machine& machine, const Kinematics& kinematics,
                                  std::span<const SolidBody> solids, std::span<const JointValues> track,
                                  double required) {
  std::vector<BodyHit> hits;
  for (const SolidBody& moving : solids)
    for (const SolidBody& standing : solids) {
      if (moving.link() <= machine.table_joints() || standing.link() > machine.table_joints()) continue;
      if (moving.empty() || standing.empty()) continue;
      if (moving.kind() == SolidKind::kTool && standing.kind() == SolidKind::kWork) continue;
      if (const auto hit = Pair(machine, kinematics, standing, moving, track, required).run()) hits.push_back(*hit);
    }
  return hits;
}

std::string hit_text(const Machine& machine, const BodyHit& hit) {
  std::string text =
      fmt::format("{} and {} come within {:.3f} mm of each other at", hit.moving, hit.standing, hit.gap_mm);
  for (const std::size_t k : machine.linear)
    text += fmt::format(" {} {:.3f}", machine.joints[k].name, in_units(machine.joints[k], hit.joints[k]));
  for (const std::size_t k : machine.rotary)
    text += fmt::format(" {} {:.3f}", machine.joints[k].name, in_units(machine.joints[k], hit.joints[k]));
  return text;
}

}  // namespace flank::internal
