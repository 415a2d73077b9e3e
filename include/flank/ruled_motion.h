/// A rigid motion of the tool axis (MATH section 2): tip rail a(t), direction rail w(t), u = w/|w|, R(s,t) = a(t) + s
/// u(t), t in [0, 1].
///
/// What is guaranteed: the axis keeps its length at every t, because u is normalised when it is evaluated. Sampled poses
/// have a proved bound of their distance to the motion (SampledMotion::chord_bound_mm), not a sampled one.
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

/// A value. Rigid by construction: u is normalised when it is evaluated, so |w| has no effect but on the
/// parametrisation.
struct RuledMotion {
  double axis_length = 0.0;  ///< mm
  BSplineCurve3 tip;         ///< clamped cubic over [0, 1], mm
  BSplineCurve3 direction;   ///< clamped cubic over [0, 1], near unit length

  /// Tip and u at t in [0, 1]. NaN if the direction rail vanishes there.
  [[nodiscard]] Pose pose(double t) const;
  /// The same with exact derivatives by t.
  [[nodiscard]] AxisJet jet(double t) const;
};

/// Least-squares motion with `count` (>= 4) control points per rail through poses at parameters t in [0, 1]; the knots
/// are equally spaced. Throws InternalError if there are fewer poses than control points, or not one parameter for
/// each.
[[nodiscard]] RuledMotion fit_motion(const std::vector<Pose>& poses, const std::vector<double>& t, double axis_length,
                                     int count);

struct SamplingOptions {
  /// mm, > 0: largest distance between the motion and the joined poses, at both ends of the axis (and so between them).
  /// The number of poses grows as its inverse square root. Well below the tolerance of the part, which pays for it.
  double chord_tolerance_mm = 1e-4;
  /// >= 2. Raise it if something else than the chord needs poses that are close together.
  int minimum_poses = 2;
  /// Radians, > 0: between two poses the path of no point of the axis turns by more than this, where it moves by more
  /// than the chord tolerance. Slow corners get more poses than the chord needs; a cusp keeps its turn.
  double largest_turn_rad = 1e300;
  /// >= minimum_poses: what the controller or the file can take. If it is too few, the tolerance gives way.
  int maximum_poses = 100000;
};
struct SampledMotion {
  std::vector<Pose> poses;
  std::vector<double> t;        ///< of each pose, rising from 0 to 1
  double chord_bound_mm = 0.0;  ///< proven bound of the distance between the motion and the joined poses
};
/// Samples a motion adaptively in t. The bound comes from the second derivatives of the rails over each step, not from
/// sampling (docs/algorithms/envelope.md). Throws UsageError if the options contradict each other, InternalError if a
/// rail is rational or of degree below 2, or if the direction rail vanishes.
[[nodiscard]] SampledMotion sample_motion(const RuledMotion& motion, const SamplingOptions& options);

}  // namespace flank
