#include "flank/machine/control_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace flank::internal {
namespace {

/// Below this angle the plane of two directions is rounding; they are joined straight.
constexpr double kLeastTurn = 1e-12;

/// The unit vector at t in [0, 1], at constant speed of its angle.
Vec3 on_great_circle(const Vec3& from, const Vec3& to, double t) {
  const double angle = 2.0 * std::atan2((to - from).norm(), (to + from).norm());
  if (angle < kLeastTurn) return (from + t * (to - from)).normalized();
  return (std::sin((1.0 - t) * angle) * from + std::sin(t * angle) * to).normalized();
}

/// All joints linear in t.
JointValues between(const JointValues& from, const JointValues& to, double t) {
  JointValues q{};
  for (std::size_t k = 0; k < kJointCount; ++k) q[k] = from[k] + t * (to[k] - from[k]);
  return q;
}

}  // namespace

RotaryValues nearest_rotary(const Kinematics& kinematics, const Vec3& direction, const RotaryValues& near) {
  const RotarySolutions solutions = kinematics.rotary(direction, near[0]);
  RotaryValues best = near;
  double least = std::numeric_limits<double>::infinity();
  for (int s = 0; s < solutions.count; ++s) {
    // Both angles may be moved by whole turns without changing the direction: the nearest turn is where a joint goes.
    RotaryValues values = solutions.values[static_cast<std::size_t>(s)];
    double distance = 0.0;
    for (std::size_t k = 0; k < 2; ++k) {
      const double off = std::remainder(values[k] - near[k], 2.0 * std::numbers::pi);
      values[k] = near[k] + off;
      distance += std::abs(off);
    }
    if (distance >= least) continue;
    least = distance;
    best = values;
  }
  return best;
}

Pose ControlMotion::pose(const BlockEnd& from, const BlockEnd& to, double t) const {
  if (positions_ == NcPositions::kJoint) return kinematics_.forward(between(from.joints, to.joints, t));
  const Vec3 tip = from.pose.tip + t * (to.pose.tip - from.pose.tip);
  if (join_ == NcJoin::kGreatCircle) return {tip, on_great_circle(from.pose.axis, to.pose.axis, t)};
  // The tip runs straight while the angles run linearly: the linear joints follow the control's own equations.
  return {tip, kinematics_.direction(kinematics_.rotary_of(between(from.joints, to.joints, t)))};
}

JointValues ControlMotion::joints(const BlockEnd& from, const BlockEnd& to, double t) const {
  const JointValues straight = between(from.joints, to.joints, t);
  if (positions_ == NcPositions::kJoint) return straight;
  const Pose p = pose(from, to, t);
  if (join_ == NcJoin::kAxes) return kinematics_.joints(p.tip, kinematics_.rotary_of(straight));
  // The control solves for the angles at each instant; which solution and turn it takes follows from where it stands,
  // here from the straight line between the ends.
  return kinematics_.joints(p.tip, nearest_rotary(kinematics_, p.axis, kinematics_.rotary_of(straight)));
}

double ControlMotion::bend(const BlockEnd& from, const BlockEnd& to, double height) const {
  const double h = std::abs(height);
  if (positions_ != NcPositions::kJoint && join_ == NcJoin::kGreatCircle) {
    const double angle =
        2.0 * std::atan2((to.pose.axis - from.pose.axis).norm(), (to.pose.axis + from.pose.axis).norm());
    // The tip runs straight, and the direction turns in a plane at constant speed.
    return h * angle * angle;
  }
  const auto& rotary = kinematics_.rotary_joints();
  const double first = std::abs(to.joints[rotary[0]] - from.joints[rotary[0]]);
  const double second = std::abs(to.joints[rotary[1]] - from.joints[rotary[1]]), turn = first + second;
  // u = R_a R_b u0: the first joint swings u on a circle of the radius |a x u|, which is small beside the singular direction.
  const double sine = std::max(kinematics_.sine_to_first(from.pose.axis), kinematics_.sine_to_first(to.pose.axis));
  const double swing = std::min(1.0, sine + second);
  const double axis_bend = h * (first * first * swing + 2.0 * first * second + second * second);
  if (positions_ != NcPositions::kJoint) return axis_bend;
  double linear = 0.0;
  for (std::size_t k = 0; k < kJointCount; ++k)
    if (k != kinematics_.rotary_joints()[0] && k != kinematics_.rotary_joints()[1])
      linear += std::abs(to.joints[k] - from.joints[k]);
  const double lever = std::max(kinematics_.lever(from.joints), kinematics_.lever(to.joints)) + linear;
  // Centripetal acceleration of the farthest lever, and the linear joints carried round.
  return axis_bend + lever * turn * turn + 2.0 * linear * turn;
}

}  // namespace flank::internal
