#include "flank/machine/kinematics.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace flank::internal {
namespace {

/// How far beyond the border of what is reachable a direction may lie and count as on it: rounding.
constexpr double kReachSlack = 1e-12;
/// Below this the border of what is reachable is the first rotary axis itself.
constexpr double kExactly = 1e-12;

/// Cosine and sine of an angle: they are taken once and used for several vectors.
struct Turn {
  double c, s;
  explicit Turn(double angle) : c(std::cos(angle)), s(std::sin(angle)) {}
};

/// v turned about the unit vector n (Rodrigues).
Vec3 turned(const Vec3& v, const Vec3& n, const Turn& t) {
  return t.c * v + t.s * n.cross(v) + ((1.0 - t.c) * n.dot(v)) * n;
}

/// The angle within [-pi, pi].
double wrapped(double angle) { return std::remainder(angle, 2.0 * std::numbers::pi); }

}  // namespace

Kinematics::Kinematics(const Machine& machine, double tool_length) {
  std::size_t linear = 0, rotary = 0;
  for (std::size_t k = 0; k < kJointCount; ++k) {
    const Joint& joint = machine.joints[k];
    const bool turns = joint.kind == JointKind::kRotary;
    // With the sign taken into the direction, formulas know nothing of reversed joints.
    links_[k] = {turns, joint.reversed ? Vec3(-joint.direction) : joint.direction, joint.point};
    if (turns)
      rotary_[rotary++] = k;
    else
      linear_[linear++] = k;
  }
  axis_ = machine.tool_axis;
  // The controlled point where all joints are zero.
  tip_ = machine.gauge - tool_length * axis_;
  // a . R_b(t) u0 = mean + cosine cos t + sine sin t lies within mean +- swing: how far these ends stay away from 1
  // and -1 tells which directions round a and -a are out of reach.
  const Vec3 &a = links_[rotary_[0]].direction, &b = links_[rotary_[1]].direction;
  mean_ = a.dot(b) * b.dot(axis_);
  cosine_ = a.dot(axis_) - mean_;
  sine_ = a.dot(b.cross(axis_));
  swing_ = std::hypot(cosine_, sine_);
  // Of a machine whose axes meet at right angles both are 0; rounding would open a cone that it cannot reach.
  const auto exact = [](double x) { return std::abs(x) < kExactly ? 0.0 : x; };
  short_of_a_ = exact(1.0 - mean_ - swing_);
  short_of_minus_a_ = exact(1.0 + mean_ - swing_);
}

Kinematics::Frame Kinematics::frame(const RotaryValues& rotary) const {
  const std::array<Turn, 2> turn{Turn(rotary[0]), Turn(rotary[1])};
  Frame f;
  f.origin = tip_;
  f.axis = axis_;
  std::size_t r = 2, l = 3;
  // From the tool to the work: each rotary joint turns everything that it carries, also the directions of the linear
  // joints behind it.
  for (std::size_t k = kJointCount; k-- > 0;) {
    const Link& link = links_[k];
    if (!link.rotary) {
      f.linear[--l] = link.direction;
      continue;
    }
    const Turn& t = turn[--r];
    f.origin = link.point + turned(f.origin - link.point, link.direction, t);
    f.axis = turned(f.axis, link.direction, t);
    for (std::size_t i = l; i < 3; ++i) f.linear[i] = turned(f.linear[i], link.direction, t);
  }
  return f;
}

Pose Kinematics::forward(const JointValues& q) const {
  const Frame f = frame(rotary_of(q));
  Vec3 tip = f.origin;
  for (std::size_t k = 0; k < 3; ++k) tip += q[linear_[k]] * f.linear[k];
  return {tip, f.axis};
}

Vec3 Kinematics::direction(const RotaryValues& rotary) const {
  const Vec3 near = turned(axis_, links_[rotary_[1]].direction, Turn(rotary[1]));
  return turned(near, links_[rotary_[0]].direction, Turn(rotary[0]));
}

// Cramer's rule: point = origin + sum of q_k linear_k. The determinant is not 0 where all linear joints lie on one
// side of the rotary ones (machine_file.cpp demands it at zero, and a common turn keeps it). Elsewhere they may come to
// lie in a plane at some angle: the values are then not numbers, and no travel holds them.
JointValues Kinematics::joints(const Vec3& point, const RotaryValues& rotary) const {
  const Frame f = frame(rotary);
  const Vec3 d = point - f.origin;
  const Vec3 bc = f.linear[1].cross(f.linear[2]);
  const double determinant = f.linear[0].dot(bc);
  JointValues q{};
  q[linear_[0]] = d.dot(bc) / determinant;
  q[linear_[1]] = f.linear[0].dot(d.cross(f.linear[2])) / determinant;
  q[linear_[2]] = f.linear[0].dot(f.linear[1].cross(d)) / determinant;
  q[rotary_[0]] = rotary[0];
  q[rotary_[1]] = rotary[1];
  return q;
}

RotarySolutions Kinematics::rotary(const Vec3& direction, double first) const {
  const Vec3 &a = links_[rotary_[0]].direction, &b = links_[rotary_[1]].direction;
  // swing cos(t - phase) = a u - mean. The two factors of its sine are taken from |u - a| and |u + a|, which keep their
  // digits where the sine vanishes.
  const double toward = 0.5 * (direction - a).squaredNorm() - short_of_a_;
  const double away = 0.5 * (direction + a).squaredNorm() - short_of_minus_a_;
  RotarySolutions solutions;
  solutions.sine = direction.cross(a).norm();
  if (toward < -kReachSlack || away < -kReachSlack) return solutions;
  const double sine = std::sqrt(std::max(toward, 0.0) * std::max(away, 0.0));
  const double swing = std::atan2(sine, a.dot(direction) - mean_), phase = std::atan2(sine_, cosine_);
  solutions.count = 2;
  solutions.singular = solutions.sine < kSingularSine;
  for (std::size_t k = 0; k < 2; ++k) {
    // The two solutions lie on either side of the phase, at which R_b u0 is nearest to a.
    const double near_tool = wrapped(phase + (k == 0 ? swing : -swing));
    const Vec3 v = turned(axis_, b, Turn(near_tool));
    const Vec3 across = a.cross(v);
    // The angle about a from R_b u0 to u: both are first laid into the plane across a.
    const double near_work =
        solutions.singular ? first : std::atan2(across.dot(direction), v.dot(direction) - a.dot(v) * a.dot(direction));
    solutions.values[k] = {near_work, near_tool};
  }
  return solutions;
}

double Kinematics::sine_to_first(const Vec3& from, const Vec3& to) const {
  const Vec3 &a = links_[rotary_[0]].direction, along = to - from;
  // Across the axis the join is a straight line, and what matters is its place nearest to the axis.
  const Vec3 start = from - a.dot(from) * a, across = along - a.dot(along) * a;
  const double squared = across.squaredNorm();
  const double t = squared > 0.0 ? std::clamp(-start.dot(across) / squared, 0.0, 1.0) : 0.0;
  return sine_to_first((from + t * along).normalized());
}

Eigen::Isometry3d Kinematics::link(const JointValues& q, std::size_t joints) const {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  for (std::size_t k = 0; k < joints; ++k) {
    const Link& link = links_[k];
    if (link.rotary)
      motion = motion * Eigen::Translation3d(link.point) * Eigen::AngleAxisd(q[k], link.direction) *
               Eigen::Translation3d(-link.point);
    else
      motion = motion * Eigen::Translation3d(q[k] * link.direction);
  }
  return motion;
}

// Down the chain as in frame(): the point is where it stands before the joint turns, and so is its distance from the
// axis.
double Kinematics::lever(const JointValues& q) const {
  double lever = 0.0;
  Vec3 p = tip_;
  for (std::size_t k = kJointCount; k-- > 0;) {
    const Link& link = links_[k];
    if (!link.rotary) {
      p += q[k] * link.direction;
      continue;
    }
    lever = std::max(lever, (p - link.point).cross(link.direction).norm());
    p = link.point + turned(p - link.point, link.direction, Turn(q[k]));
  }
  return lever;
}

}  // namespace flank::internal
