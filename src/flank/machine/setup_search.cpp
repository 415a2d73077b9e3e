#include "flank/machine/setup_search.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "flank/error.h"

namespace flank::internal {
namespace {

constexpr std::size_t kMostPoses = 200;  // every try chooses joints for all of them, and there are hundreds of tries
/// Far enough from the singular direction: beyond it more is no better.
constexpr double kEnoughSine = 0.5;
/// A joint that comes as near to the end of its travel as this is not worth less: mm, and radians.
constexpr double kEnoughRoomMm = 50.0, kEnoughRoomRad = 0.35;

/// A rotary joint that turns by less while the tool cuts stands still, radians.
constexpr double kStill = 1e-4;
/// What a joint that stands still is worth: as much as being away from the singular direction; and what a turn of the others costs, up
/// to so many turns.
constexpr double kStillWorth = 2.0, kTurnPrice = 0.2, kMostTurns = 4.0;

/// Evenly, with both ends: a strip's ends reach farthest.
std::vector<std::size_t> thinned(std::size_t count) {
  std::vector<std::size_t> few;
  if (count <= kMostPoses)
    for (std::size_t k = 0; k < count; ++k) few.push_back(k);
  else
    for (std::size_t k = 0; k < kMostPoses; ++k) few.push_back(k * (count - 1) / (kMostPoses - 1));
  return few;
}

/// a, b, c of Rz(c) Ry(b) Rx(a), degrees, to 1e-6.
std::array<double, 3> angles_of(const Eigen::Matrix3d& r) {
  const double degrees = 180.0 / std::numbers::pi;
  const double flat = std::hypot(r(0, 0), r(1, 0));
  std::array<double, 3> a{};
  a[1] = std::atan2(-r(2, 0), flat);
  if (flat > 1e-9) {
    a[0] = std::atan2(r(2, 1), r(2, 2));
    a[2] = std::atan2(r(1, 0), r(0, 0));
  } else {
    // The part's X along the machine's -Z or Z: a and c turn about the same line, so all goes into a.
    a[0] = std::atan2(-r(1, 2), r(1, 1));
  }
  // What is proposed will be typed: -90 and not -90.00000000000001. Adding zero turns -0 into 0.
  for (double& angle : a) angle = std::round(angle * degrees * 1e6) / 1e6 + 0.0;
  return a;
}

/// The 24 turns that keep the part's axes along the machine's: where X goes, where Y goes across it, Z follows.
std::vector<std::array<double, 3>> square_turns() {
  std::vector<std::array<double, 3>> turns;
  for (int x = 0; x < 3; ++x)
    for (int sx = -1; sx <= 1; sx += 2)
      for (int y = 0; y < 3; ++y)
        for (int sy = -1; sy <= 1; sy += 2) {
          if (x == y) continue;
          Eigen::Matrix3d r;
          r.col(0) = sx * Vec3::Unit(x);
          r.col(1) = sy * Vec3::Unit(y);
          r.col(2) = r.col(0).cross(r.col(1));
          turns.push_back(angles_of(r));
        }
  // As it is in its file comes first: of equal turns the first wins.
  std::stable_sort(turns.begin(), turns.end(), [](const auto& a, const auto& b) {
    const auto size = [](const auto& t) { return std::abs(t[0]) + std::abs(t[1]) + std::abs(t[2]); };
    return size(a) < size(b);
  });
  return turns;
}

/// The least turn that brings one direction to that of a unit vector. (Eigen's own needs a singular value decomposition for
/// opposite ones, which takes four times as long to compile as the rest of this file.)
Eigen::AngleAxisd least_turn(const Vec3& from, const Vec3& to) {
  const Vec3 across = from.cross(to);
  const double sine = across.norm(), cosine = from.dot(to);
  const bool along = sine <= 1e-12 * std::abs(cosine);
  return {std::atan2(sine, cosine), along ? to.unitOrthogonal() : Vec3(across / sine)};
}

/// Turns that bring the path's middle direction to several tilts from the spindle, in several azimuths.
std::vector<std::array<double, 3>> tilted_turns(const Vec3& spindle, const std::vector<Pose>& poses) {
  Vec3 middle = Vec3::Zero();
  for (const Pose& p : poses) middle += p.axis;
  // The tool points everywhere: there is no direction to tilt.
  if (middle.norm() < 1e-6) return {};
  std::vector<std::array<double, 3>> turns;
  const double radians = std::numbers::pi / 180.0;
  // The likely ones first, since of equal turns the first wins; 5 degrees is nearly singular, and comes last.
  for (const double tilt : {20.0, 35.0, 50.0, 65.0, 80.0, 5.0})
    for (double azimuth = 0.0; azimuth < 360.0; azimuth += 45.0)
      for (double spin = 0.0; spin < 360.0; spin += 90.0) {
        const Eigen::AngleAxisd up = least_turn(middle, spindle);
        const Vec3 side = Eigen::AngleAxisd(azimuth * radians, spindle) * spindle.unitOrthogonal();
        turns.push_back(
            angles_of((Eigen::AngleAxisd(tilt * radians, side) * Eigen::AngleAxisd(spin * radians, spindle) * up)
                          .toRotationMatrix()));
      }
  return turns;
}

/// Turns that bring a direction of the part to the spindle, a quarter apart about it; the one nearest to the part's own frame first.
std::vector<std::array<double, 3>> upward_turns(const Vec3& spindle, const Vec3& up) {
  std::vector<std::array<double, 3>> turns;
  for (double spin = 0.0; spin < 360.0; spin += 90.0)
    turns.push_back(angles_of(
        (Eigen::AngleAxisd(spin * std::numbers::pi / 180.0, spindle) * least_turn(up, spindle)).toRotationMatrix()));
  return turns;
}

/// All turns and places one after the other; the best that the machine reaches is kept.
class Search {
 public:
  Search(const Machine& machine, const Kinematics& kinematics, const SetupSearch& asked,
         std::span<const SolidBody> solids)
      : machine_(machine),
        kinematics_(kinematics),
        asked_(asked),
        few_(thinned(asked.poses.size())),
        solids_(solids),
        upright_(asked.upright),
        clamping_(asked.clamping) {
    take_few();
    for (const Pose& p : poses_) box_.add(p.tip);
    if (clamping_.centred && !machine_.joints[kinematics_.rotary_joints()[0]].table)
      throw UsageError("clamp", "bore", "needs a machine whose table turns; expected bottom or any");
  }

  FoundSetup run() {
    if (clamping_.up) {
      try_all(upward_turns(machine_.tool_axis, *clamping_.up));
      return found_;
    }
    try_all(square_turns());
    // Square to the machine is how people clamp. Tilted turns are tried only if that fails, or runs beside the
    // singular direction, where the first rotary joint races.
    if (!found_.setup || (!still_ && found_.least_sine < std::sin(5.0 * std::numbers::pi / 180.0)))
      try_all(tilted_turns(machine_.tool_axis, poses_));
    return found_;
  }

 private:
  void try_all(const std::vector<std::array<double, 3>>& turns) {
    for (const auto& angles : turns) {
      WorkSetup setup;
      setup.angles_deg = angles;
      const Vec3 middle = setup.rotation() * clamping_.centred.value_or(box_.center());
      for (const Vec3& place : places()) {
        setup.translation = place - middle;
        for (int k = 0; k < 3; ++k) setup.translation(k) = std::round(setup.translation(k) * 1e3) / 1e3 + 0.0;
        if (try_one(setup) == Outcome::kDirection) break;  // no place helps
      }
    }
  }

  /// Where the middle of the path could be, in the frame of the work: over the rotary joint that carries it, at several
  /// heights; without one, in the middle of the travels.
  std::vector<Vec3> places() const {
    const Joint& near_work = machine_.joints[kinematics_.rotary_joints()[0]];
    if (!near_work.table) return {middle_of_travels()};
    std::vector<Vec3> list;
    // Upwards is towards the spindle, whichever way the joint counts.
    const double lift = machine_.tool_axis.dot(near_work.direction) < 0.0 ? -1.0 : 1.0;
    for (const double height : {50.0, 100.0, 0.0, 150.0, 200.0, 300.0, -50.0, -100.0})
      list.push_back(near_work.point + lift * height * near_work.direction);
    return list;
  }

  /// Where the controlled point is with the rotary joints at zero, in the frame of the work, mm.
  Vec3 middle_of_travels() const {
    JointValues q{};
    for (const std::size_t k : machine_.linear) q[k] = 0.5 * (machine_.joints[k].low + machine_.joints[k].high);
    return kinematics_.forward(q).tip;
  }

  enum class Outcome { kFits, kPlace, kDirection };
  Outcome try_one(const WorkSetup& setup) {
    ++found_.tried;
    const std::vector<MachinePose> placed = placed_in(setup, poses_);
    if (std::string why = not_upright(setup); !why.empty()) {
      found_.reason = std::move(why);
      return Outcome::kPlace;
    }
    const JointChoice choice = choose_joints(machine_, kinematics_, placed);
    if (choice.unreachable) {
      found_.reason = choice.unreachable->reason;
      // A direction that no angles hold stays so wherever the part sits: then the other places need not be tried.
      return kinematics_.rotary(placed[choice.unreachable->pose].pose.axis, 0.0).count == 0 ? Outcome::kDirection
                                                                                            : Outcome::kPlace;
    }
    const double worth = worth_of(choice);
    // Looked at only where it could win: distances cost more than angles.
    if (found_.setup && worth <= worth_ + 1e-9) return Outcome::kFits;
    if (std::string why = not_held_between(setup, choice); !why.empty()) {
      found_.reason = std::move(why);
      return Outcome::kPlace;
    }
    // Better by more than rounding: else the first stays, for any machine that this runs on.
    if (!found_.setup || worth > worth_ + 1e-9) {
      worth_ = worth;
      found_.setup = setup;
      found_.least_sine = choice.least_sine;
      still_ = rotary_use(choice).still > 0;
    }
    return Outcome::kFits;
  }

  /// Why the machine cannot stand above the part with its rotary joints at zero; empty if it can, or need not.
  std::string not_upright(const WorkSetup& setup) const {
    if (!upright_) return {};
    const Vec3 up = setup.rotation().transpose() * kinematics_.direction({0.0, 0.0});
    return travel_violation(machine_, kinematics_.joints(setup.to_work(upright_(up)).tip, {0.0, 0.0}));
  }

  static std::vector<MachinePose> placed_in(const WorkSetup& setup, std::span<const Pose> poses) {
    std::vector<MachinePose> placed;
    for (const Pose& p : poses) placed.push_back({setup.to_work(p), !placed.empty()});
    return placed;
  }

  void take_few() {
    poses_.clear();
    cutting_.clear();
    for (const std::size_t k : few_) {
      poses_.push_back(asked_.poses[k]);
      cutting_.push_back(asked_.cutting.empty() || asked_.cutting[k]);
    }
  }

  /// What few poses do not show, of a set-up that would win: a pose that was left out may be beyond a travel, and solids may meet. Empty if
  /// neither is so. A pose of the path that is so is among the few from then on.
  std::string not_held_between(const WorkSetup& setup, const JointChoice& choice) {
    const auto ways = asked_.whole ? asked_.whole(setup) : std::vector<std::vector<Pose>>{asked_.poses};
    for (const std::vector<Pose>& way : ways)
      if (const auto missed = choose_joints(machine_, kinematics_, placed_in(setup, way)).unreachable) {
        look_at(way[missed->pose]);
        return missed->reason;
      }
    const std::optional<BodyHit> hit = first_hit(choice);
    return hit ? hit_text(machine_, *hit) : std::string();
  }

  void look_at(const Pose& pose) {
    const auto same = [&](const Pose& p) { return p.tip == pose.tip && p.axis == pose.axis; };
    const auto found = std::find_if(asked_.poses.begin(), asked_.poses.end(), same);
    if (found == asked_.poses.end()) return;
    const auto index = static_cast<std::size_t>(found - asked_.poses.begin());
    const auto at = std::lower_bound(few_.begin(), few_.end(), index);
    if (at == few_.end() || *at != index) few_.insert(at, index);
    take_few();
  }

  /// At the poses alone: the whole motion is judged when it is known.
  std::optional<BodyHit> first_hit(const JointChoice& choice) const {
    for (const JointValues& q : choice.joints) {
      std::vector<BodyHit> hits = check_bodies(machine_, kinematics_, solids_, std::span(&q, 1), 0.0);
      if (!hits.empty()) return std::move(hits.front());
    }
    return std::nullopt;
  }

  /// What the rotary joints do while the tool cuts.
  struct RotaryUse {
    int still = 0;              ///< joints that do not turn
    bool second_still = false;  ///< the one next to the tool is one of them
    double turns = 0.0;         ///< of both together, there and back
  };
  RotaryUse rotary_use(const JointChoice& choice) const {
    RotaryUse use;
    for (std::size_t r = 0; r < 2; ++r) {
      const std::size_t joint = kinematics_.rotary_joints()[r];
      double low = 0.0, high = 0.0;
      bool any = false;
      for (std::size_t k = 0; k < choice.joints.size(); ++k) {
        if (!cutting_[k]) continue;
        const double at = choice.joints[k][joint];
        low = any ? std::min(low, at) : at;
        high = any ? std::max(high, at) : at;
        if (k > 0 && cutting_[k - 1])
          use.turns += std::abs(at - choice.joints[k - 1][joint]) / (2.0 * std::numbers::pi);
        any = true;
      }
      const bool still = any && high - low < kStill;
      use.still += still ? 1 : 0;
      if (r == 1) use.second_still = still;
    }
    return use;
  }

  /// Joints that stand still, away from the singular direction, few turns, well inside the travels, tilted little.
  double worth_of(const JointChoice& choice) const {
    double room = 1.0, tilt = 0.0;
    const std::size_t near_tool = kinematics_.rotary_joints()[1];
    for (const JointValues& q : choice.joints) {
      for (std::size_t k = 0; k < kJointCount; ++k) {
        const Joint& joint = machine_.joints[k];
        const double enough = joint.kind == JointKind::kRotary ? kEnoughRoomRad : kEnoughRoomMm;
        room = std::min({room, (q[k] - joint.low) / enough, (joint.high - q[k]) / enough});
      }
      tilt = std::max(tilt, std::abs(q[near_tool]));
    }
    const RotaryUse use = rotary_use(choice);
    // Beside the singular direction the first joint races only where the tilt changes.
    const double away = use.second_still ? 1.0 : std::min(choice.least_sine, kEnoughSine) / kEnoughSine;
    return 2.0 * away + kStillWorth * use.still - kTurnPrice * std::min(use.turns, kMostTurns) + std::max(room, 0.0) -
           0.5 * tilt / std::numbers::pi;
  }

  const Machine& machine_;
  const Kinematics& kinematics_;
  const SetupSearch& asked_;
  std::vector<std::size_t> few_;  ///< poses, ascending: so few that hundreds of tries are quick
  std::vector<Pose> poses_;       ///< these
  std::span<const SolidBody> solids_;
  const UprightPlace& upright_;
  const Clamping& clamping_;
  std::vector<bool> cutting_;
  bool still_ = false;  ///< of what was found: a rotary joint stands still while the tool cuts
  Box3 box_;
  double worth_ = 0.0;
  FoundSetup found_;
};

}  // namespace

FoundSetup search_setup(const Machine& machine, const Kinematics& kinematics, const SetupSearch& search,
                        std::span<const SolidBody> solids) {
  return Search(machine, kinematics, search, solids).run();
}

}  // namespace flank::internal
