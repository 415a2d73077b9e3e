/// A rigid motion of the tool axis (MATH section 2): tip rail a(t), direction rail w(t), u = w/|w|, R(s,t) = a(t) + s
/// u(t), t in [0, 1].
#pragma once

#include <vector>

#include "flank/bspline_curve.h"
#include "flank/path.h"
#include "flank/vec.h"

namespace flank {

/// Pose and its velocity: tip, u, and d/dt of both.
struct AxisJet {
  Vec3 tip, u;
  Vec3 tip_d1, u_d1;
  [[nodiscard]] Vec3 at(double s) const { return tip + s * u; }
  [[nodiscard]] Vec3 velocity(double s) const { return tip_d1 + s * u_d1; }
};

struct RuledMotion {
  double axis_length = 0.0;  ///< mm
  BSplineCurve3 tip;         ///< clamped cubic over [0, 1], mm
  BSplineCurve3 direction;   ///< clamped cubic over [0, 1], near unit length

  [[nodiscard]] Pose pose(double t) const;
  [[nodiscard]] AxisJet jet(double t) const;
};

/// Least-squares motion with `count` control points a rail through poses at parameters t in [0, 1] (poses.size() >=
/// count).
[[nodiscard]] RuledMotion fit_motion(const std::vector<Pose>& poses, const std::vector<double>& t, double axis_length,
                                     int count);

struct SamplingOptions {
  double chord_tolerance_mm =
      1e-4;  ///< largest distance between the motion and the joined poses, at both ends of the axis
  int minimum_poses = 2;
  int maximum_poses = 100000;
};
struct SampledMotion {
  std::vector<Pose> poses;
  std::vector<double> t;
  double chord_bound_mm =
      0.0;  ///< bound of the distance between the motion and the joined poses, reached by construction
};
/// Samples a motion adaptively in t. The bound comes from the second derivatives of the rails over each step, not from
/// sampling alone.
[[nodiscard]] SampledMotion sample_motion(const RuledMotion& motion, const SamplingOptions& options);

}  // namespace flank
