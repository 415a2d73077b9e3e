/// Targets that are the envelope of a known tool under a known motion, with that motion.
#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include "flank/envelope.h"
#include "flank/radial_function.h"
#include "flank/ruled_motion.h"
#include "flank/target.h"

namespace flank::internal::testing {

struct ExactTarget {
  RuledMotion motion;
  RadialFunction tool;
  std::unique_ptr<Target> target;  ///< machining side towards the axis
  Face face;
};

/// A smooth motion of one polynomial piece: a bent sweep whose axis turns by about 0.35 rad.
inline RuledMotion bent_motion(double axis_length) {
  RuledMotion motion;
  motion.axis_length = axis_length;
  motion.tip.knots = motion.direction.knots = uniform_knots(3, 4);
  motion.tip.poles.resize(3, 4);
  motion.direction.poles.resize(3, 4);
  for (int i = 0; i < 4; ++i) {
    const double x = i / 3.0;
    motion.tip.poles.col(i) = Vec3(60.0 * x, 9.0 * x * (1.0 - x), 4.0 * x * x);
    motion.direction.poles.col(i) = Vec3(0.10 - 0.15 * x, -0.20 + 0.35 * x, 1.0);
  }
  return motion;
}

/// The axis travels along x without turning.
inline RuledMotion straight_motion(double axis_length) {
  RuledMotion motion = bent_motion(axis_length);
  for (int i = 0; i < 4; ++i) {
    motion.tip.poles.col(i) = Vec3(20.0 * i, 0.0, 0.0);
    motion.direction.poles.col(i) = Vec3(0.0, 0.0, 1.0);
  }
  return motion;
}

/// The envelope (contact side +1) as one face through exact contact points, degree 5.
inline ExactTarget exact_target(RuledMotion motion, RadialFunction tool) {
  constexpr int kT = 25, kS = 21;
  std::vector<double> t(kT), s(kS);
  std::vector<Vec3> points;
  for (int i = 0; i < kT; ++i) t[static_cast<std::size_t>(i)] = static_cast<double>(i) / (kT - 1);
  for (int j = 0; j < kS; ++j) s[static_cast<std::size_t>(j)] = static_cast<double>(j) / (kS - 1);
  for (const ContactPoint& contact : sample_envelope(motion, tool, +1, kT, kS)) points.push_back(contact.point);
  ExactTarget out;
  out.face.id = "F1";
  out.face.surface = interpolate_grid(points, t, s, 5);
  const SurfaceJet middle = out.face.surface.jet(0.5, 0.5);
  const Vec3 to_axis = motion.pose(0.5).at(0.5 * motion.axis_length) - middle.p;
  out.face.reversed = middle.du.cross(middle.dv).dot(to_axis) < 0.0;
  out.target = make_target({out.face});
  out.motion = std::move(motion);
  out.tool = std::move(tool);
  return out;
}

inline ExactTarget barrel_target() {
  constexpr double kLength = 40.0;
  return exact_target(bent_motion(kLength),
                      RadialFunction(ToolFamily::kBarrel, kLength, Eigen::Vector3d(160.0, 6.0, 18.0)));
}

inline ExactTarget cone_target() {
  constexpr double kLength = 40.0;
  return exact_target(bent_motion(kLength), RadialFunction(ToolFamily::kCone, kLength, Eigen::Vector2d(4.0, 0.08)));
}

/// A cylinder swept along a straight line: a plane.
inline ExactTarget plane_target() {
  constexpr double kLength = 30.0;
  return exact_target(straight_motion(kLength),
                      RadialFunction(ToolFamily::kCylinder, kLength, Eigen::VectorXd::Constant(1, 5.0)));
}

/// The pose with both ends moved: a user's line that is off.
inline Pose pose_off(const Pose& pose, double axis_length, const Vec3& tip_shift, const Vec3& holder_shift) {
  const Vec3 a = pose.tip + tip_shift, b = pose.at(axis_length) + holder_shift;
  return {a, (b - a).normalized()};
}

}  // namespace flank::internal::testing
