#include "flank/machine/joint_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

namespace flank::internal {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
/// A joint that turns this often counts as endless: its turn follows from the step before, and is checked when all is done.
constexpr double kManyTurns = 5.0 * kTurn;
/// Of the price of a step: being away from zero at the start, so that of equal choices the nearest wins.
constexpr double kStartPrice = 1e-3;
/// Travels are kept up to rounding.
constexpr double kTravelSlack = 1e-9;

/// One way to hold a pose, and the cheapest way to get there: a node of the dynamic programme.
struct State {
  RotaryValues rotary{};
  std::int8_t solution = 0;
  double price = std::numeric_limits<double>::infinity();  // s, of all steps up to here
  std::int32_t before = -1;                                // index of a state of the pose before
};

/// So many turns, or no limit: to list them all as states would cost much and decide nothing.
bool endless(const Joint& joint) { return !(joint.high - joint.low < kManyTurns); }

/// The search over layers of states, one layer a pose.
class Choice {
 public:
  Choice(const Machine& machine, const Kinematics& kinematics, std::span<const MachinePose> poses, double cone)
      : machine_(machine), kinematics_(kinematics), poses_(poses), cone_(cone) {
    for (std::size_t k = 0; k < 2; ++k) joint_[k] = &machine.joints[kinematics.rotary_joints()[k]];
  }

  JointChoice run() {
    JointChoice result;
    const double first = first_angle();
    layers_.resize(poses_.size());
    for (std::size_t k = 0; k < poses_.size(); ++k) {
      const RotarySolutions solutions = kinematics_.rotary(poses_[k].pose.axis, first);
      result.least_sine = std::min(result.least_sine, solutions.sine);
      if (solutions.count > 0) add_layer(k, solutions);
      if (layers_[k].empty()) return refused(k, solutions);
    }
    trace_back(result);
    return result;
  }

 private:
  /// Of the first pose that is not singular: what a singular one before it takes.
  double first_angle() const {
    for (const MachinePose& p : poses_) {
      const RotarySolutions s = kinematics_.rotary(p.pose.axis, 0.0);
      if (s.count > 0 && !s.singular) return s.values[0][0];
    }
    return 0.0;
  }

  /// Turns do not matter to the linear joints: a rotary joint stands at the same place after each.
  bool linear_inside(std::size_t pose, const RotaryValues& rotary) const {
    const JointValues q = kinematics_.joints(poses_[pose].pose.tip, rotary);
    for (const std::size_t k : machine_.linear) {
      const Joint& joint = machine_.joints[k];
      // Not a number where the linear joints lie in a plane: that is not inside, either.
      if (!(q[k] >= joint.low - kTravelSlack && q[k] <= joint.high + kTravelSlack)) return false;
    }
    return true;
  }

  bool rotary_inside(std::size_t k, double value) const {
    return value >= joint_[k]->low - kTravelSlack && value <= joint_[k]->high + kTravelSlack;
  }

  /// All turns of an angle within a joint's travel; the angle itself where it turns endlessly.
  std::vector<double> turns(std::size_t k, double angle) const {
    if (endless(*joint_[k])) return {angle};
    std::vector<double> all;
    const double low = joint_[k]->low - kTravelSlack;
    for (double value = angle + kTurn * std::ceil((low - angle) / kTurn); rotary_inside(k, value); value += kTurn)
      all.push_back(value);
    return all;
  }

  /// Time of both rotary joints one after the other, s: never less than what the machine needs, and without ties
  /// where one of the two waits for the other.
  double step_price(const RotaryValues& from, const RotaryValues& to) const {
    return std::abs(to[0] - from[0]) / joint_[0]->speed + std::abs(to[1] - from[1]) / joint_[1]->speed;
  }

  /// Whether the control, running the rotary joints from one to the other, stays with the path: halfway it is no farther
  /// off than the path's own turn. A change between the solutions away from the singular direction is not.
  bool runs_along(std::size_t pose, const RotaryValues& from, const RotaryValues& to) const {
    const double step = std::max(std::abs(to[0] - from[0]), std::abs(to[1] - from[1]));
    const Vec3 &u0 = poses_[pose - 1].pose.axis, &u1 = poses_[pose].pose.axis;
    const double turn = (u1 - u0).norm();
    if (step <= turn) return true;
    const Vec3 half = kinematics_.direction({0.5 * (from[0] + to[0]), 0.5 * (from[1] + to[1])});
    return (half - (u0 + u1).normalized()).norm() <= turn + kTravelSlack;
  }

  /// States that are equal to the last bit are one: nothing after them could tell them apart, so the cheaper one
  /// stays. Without this their number would grow with every pose.
  void offer(std::vector<State>& layer, State state) const {
    for (State& known : layer)
      if (known.solution == state.solution && known.rotary == state.rotary) {
        if (state.price < known.price) known = state;
        return;
      }
    layer.push_back(state);
  }

  /// The first pose can be held in every turn that the travels have; later turns follow from it.
  void add_first(std::size_t pose, int solution, const RotaryValues& rotary) {
    for (const double near_work : turns(0, rotary[0]))
      for (const double near_tool : turns(1, rotary[1])) {
        const RotaryValues values{near_work, near_tool};
        if (!linear_inside(pose, values)) continue;
        offer(layers_[pose],
              {values, static_cast<std::int8_t>(solution), kStartPrice * step_price({0.0, 0.0}, values), -1});
      }
  }

  /// The turn nearest to where the joint stands.
  static double nearest(double angle, double at) { return angle + kTurn * std::round((at - angle) / kTurn); }

  /// A joint that comes from the pose before cannot jump by a turn: it takes the nearest one, or there is no such
  /// step.
  void add_joined(std::size_t pose, int solution, const RotarySolutions& solutions) {
    const RotaryValues& rotary = solutions.values[static_cast<std::size_t>(solution)];
    const bool changes = kinematics_.sine_to_first(poses_[pose - 1].pose.axis, poses_[pose].pose.axis) <= cone_;
    std::optional<bool> inside;  // the same for all turns, but where the first angle is free
    for (std::size_t i = 0; i < layers_[pose - 1].size(); ++i) {
      const State& from = layers_[pose - 1][i];
      if (from.solution != solution && !changes) continue;
      const RotaryValues to{solutions.singular ? from.rotary[0] : nearest(rotary[0], from.rotary[0]),
                            nearest(rotary[1], from.rotary[1])};
      if (!rotary_inside(0, to[0]) || !rotary_inside(1, to[1]) || !runs_along(pose, from.rotary, to)) continue;
      if (!inside || solutions.singular) inside = linear_inside(pose, to);
      if (!*inside) continue;
      offer(layers_[pose], {to, static_cast<std::int8_t>(solution), from.price + step_price(from.rotary, to),
                            static_cast<std::int32_t>(i)});
    }
  }

  /// The machine comes from its reference position: it may unwind, so every turn within the travel is open.
  void add_free(std::size_t pose, int solution, const RotarySolutions& solutions) {
    const RotaryValues& rotary = solutions.values[static_cast<std::size_t>(solution)];
    if (!linear_inside(pose, rotary)) return;
    for (std::size_t i = 0; i < layers_[pose - 1].size(); ++i) {
      const State& from = layers_[pose - 1][i];
      // turns() gives an endless joint's angle back as it is: it should be the one next to where the joint stands.
      const double near_work = endless(*joint_[0]) ? nearest(rotary[0], from.rotary[0]) : rotary[0];
      const double near_tool = endless(*joint_[1]) ? nearest(rotary[1], from.rotary[1]) : rotary[1];
      for (const double a : turns(0, near_work))
        for (const double b : turns(1, near_tool)) {
          const RotaryValues to{a, b};
          offer(layers_[pose], {to, static_cast<std::int8_t>(solution), from.price + step_price(from.rotary, to),
                                static_cast<std::int32_t>(i)});
        }
    }
  }

  void add_layer(std::size_t pose, const RotarySolutions& solutions) {
    for (int s = 0; s < solutions.count; ++s) {
      if (pose == 0)
        add_first(pose, s, solutions.values[static_cast<std::size_t>(s)]);
      else if (poses_[pose].joined)
        add_joined(pose, s, solutions);
      else
        add_free(pose, s, solutions);
    }
  }

  /// From the cheapest state of the last pose back to the first one.
  void trace_back(JointChoice& result) const {
    result.joints.resize(poses_.size());
    std::size_t best = 0;
    for (std::size_t i = 1; i < layers_.back().size(); ++i)
      if (layers_.back()[i].price < layers_.back()[best].price) best = i;
    for (std::size_t k = poses_.size(); k-- > 0;) {
      const State& state = layers_[k][best];
      result.joints[k] = kinematics_.joints(poses_[k].pose.tip, state.rotary);
      if (k == 0) break;
      best = static_cast<std::size_t>(state.before);
      if (poses_[k].joined && layers_[k - 1][best].solution != state.solution) ++result.flips;
    }
  }

  /// What keeps the tool from pose `k`: the direction, a joint's travel, or that no turn goes on from the pose before.
  JointChoice refused(std::size_t k, const RotarySolutions& solutions) const {
    Unreachable why{.pose = k, .joint = {}, .reason = {}};
    if (solutions.count == 0) {
      why.joint = joint_[1]->name;
      why.reason = fmt::format("axis {} cannot tilt the tool into this direction at all", joint_[1]->name);
      return {.joints = {}, .unreachable = why};
    }
    for (const RotaryValues& rotary : solutions.values) {
      JointValues q = kinematics_.joints(poses_[k].pose.tip, rotary);
      // An angle out of the travel by whole turns is no fault: the message is about the nearest that fits.
      for (std::size_t r = 0; r < 2; ++r)
        if (const std::vector<double> all = turns(r, rotary[r]); !all.empty())
          q[kinematics_.rotary_joints()[r]] = all.front();
      std::string joint;
      const std::string violation = travel_violation(machine_, q, &joint);
      // The pose itself can be held: only the way to it is closed.
      if (violation.empty()) {
        why.joint = joint_[0]->name;
        why.reason = fmt::format(
            "axes {} and {} cannot continue from the CL point before: one of them would leave its travel, or jump",
            joint_[0]->name, joint_[1]->name);
        return {.joints = {}, .unreachable = why};
      }
      if (why.reason.empty()) why = {.pose = k, .joint = joint, .reason = violation};
    }
    return {.joints = {}, .unreachable = why};
  }

  const Machine& machine_;
  const Kinematics& kinematics_;
  std::span<const MachinePose> poses_;
  double cone_;
  std::array<const Joint*, 2> joint_{};
  std::vector<std::vector<State>> layers_;
};

}  // namespace

std::string travel_violation(const Machine& machine, const JointValues& q, std::string* name) {
  for (std::size_t k = 0; k < kJointCount; ++k) {
    const Joint& joint = machine.joints[k];
    if (q[k] >= joint.low - kTravelSlack && q[k] <= joint.high + kTravelSlack) continue;
    if (name != nullptr) *name = joint.name;
    return fmt::format("axis {} would stand at {:.3f} {}, its travel is {:g} to {:g}", joint.name,
                       in_units(joint, q[k]), joint.kind == JointKind::kRotary ? "degrees" : "mm",
                       in_units(joint, joint.low), in_units(joint, joint.high));
  }
  return {};
}

JointChoice choose_joints(const Machine& machine, const Kinematics& kinematics, std::span<const MachinePose> poses,
                          double cone) {
  if (poses.empty()) return {};
  JointChoice choice = Choice(machine, kinematics, poses, cone).run();
  // Endless joints were not held to their travel in the search; here everything is, once more.
  for (std::size_t k = 0; k < choice.joints.size(); ++k) {
    std::string joint;
    const std::string violation = travel_violation(machine, choice.joints[k], &joint);
    if (!violation.empty()) return {.joints = {}, .unreachable = Unreachable{k, joint, violation}};
  }
  return choice;
}

}  // namespace flank::internal
