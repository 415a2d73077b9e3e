/// Movability of a line along a target (MATH section 6; paper A (5), (6)): how nearly the whole axis can move so that
/// every one of its points moves tangentially to the target at its footpoint.
///
/// v(s) = v_m + (s - L/2) omega with omega across the axis; the form E = mean <n_j, v(s_j)>^2 is minimised with the
/// part of v_m across the axis of unit length. (Paper A's |v_m| = 1 lets many good lines choose to slide along
/// themselves.) Slide along the axis and omega are eliminated by a Schur complement; what remains is a symmetric 2 x 2
/// eigenproblem.
///
/// Sliding along the axis: if r' = 0 all along the axis it changes no distance; if the tool is a cone over a
/// plane it makes up for a motion along the normal. A small penalty on it chooses the motion with the least slide; it
/// is left out of the value.
///
/// The normals must be those of a smooth surface (NURBS, or a mesh with jets): the steps between facet normals swamp
/// the form. The value discriminates weakly, a line that is off by 1e-2 may show 1e-10: it ranks and steers, it accepts
/// nothing.
#pragma once

#include <span>
#include <vector>

#include "flank/target.h"
#include "flank/vec.h"

namespace flank::internal {

/// Velocity field of a rigid axis, per unit of transversal travel of its middle: `middle` has no unit, `omega` is in
/// 1/mm.
struct AxisVelocity {
  Vec3 middle = Vec3::Zero();  ///< of the point s = L/2; its part across the axis has unit length
  Vec3 omega = Vec3::Zero();   ///< d(axis)/d(travel), across the axis
  [[nodiscard]] Vec3 at(double s, double axis_length) const { return middle + (s - 0.5 * axis_length) * omega; }
};

struct MovabilityOptions {
  /// > 0, on the squared slide along the axis. 1e-8 only decides between motions of the same value; raise it (1e-3) if
  /// slide is unwelcome.
  double axial_penalty = 1e-8;
  /// > 0, on (L/2 |omega|)^2: decides turns that the target leaves open (a cylinder on a plane).
  double turn_penalty = 1e-8;
  /// Direction of travel to stay near, any length; zero: none. Decides the sign, and by `steering` between directions
  /// of nearly the same value.
  Vec3 previous = Vec3::Zero();
  /// >= 0, in units of the value: directions whose values differ by less than this follow `previous`. 1e-3 is an angle
  /// of 0.03 rad between motion and surface. 0: the smallest value decides alone.
  double steering = 1e-3;
  /// The penalties are on the differences from this velocity's slide and turn: zero, or those of the last step.
  AxisVelocity centre;
};

struct Movability {
  double value = 0.0;            ///< E at the best velocity; 0 on an exact envelope. No unit: squared sine of an angle
  AxisVelocity velocity;         ///< the best one
  double low = 0.0, high = 0.0;  ///< eigenvalues: smallest E (penalties included), and that of the direction across it
  double weight = 0.0;  ///< share of the samples that counted: 1 for those inside the target, less past its border
  [[nodiscard]] bool valid() const { return weight > 0.0; }
};

/// How much a footpoint counts: inside 1, on the extension 0.05 (it is extrapolated), on the border 0 (there is no
/// normal).
[[nodiscard]] double footpoint_weight(Location location);

/// Movability of the axis whose points s_j = L j / (n - 1) have the footpoints feet[j], n >= 2. Not valid (weight 0) if
/// no footpoint counts.
[[nodiscard]] Movability movability(std::span<const Footpoint> feet, const Pose& pose, double axis_length,
                                    const MovabilityOptions& options = {});

/// Footpoints of the points s_j = L j / (n - 1) of an axis, n = feet.size(): warm from feet if they have a patch,
/// else marched outwards from a cold query at the middle, so that they lie on one branch.
void track_axis(const Target& target, const Pose& pose, double axis_length, std::span<Footpoint> feet);

/// The same two steps for one line, cold, with `samples` footpoints.
[[nodiscard]] Movability movability(const Target& target, const Pose& pose, double axis_length, int samples = 24,
                                    const MovabilityOptions& options = {});

// What walks of a rigid axis along a target have in common: seed/propagate keeps the distances of a line, strip/grow the
// tolerance of a tool.

/// The axis after `step` of travel with a velocity: the middle moves on a line, the direction on its circle.
[[nodiscard]] Pose moved(const Pose& pose, const AxisVelocity& velocity, double axis_length, double step);

/// The velocity with which one pose became another over a step of length h.
[[nodiscard]] AxisVelocity mean_velocity(const Pose& from, const Pose& to, double axis_length, double h);

/// The most movable velocity; slide and turn that the normals leave open go on as they were in the last step.
[[nodiscard]] Movability next_velocity(std::span<const Footpoint> feet, const Pose& pose, double axis_length,
                                       const AxisVelocity& last);

/// The displacement of the end of the axis that moved farther, mm.
[[nodiscard]] double farther_end(const Pose& from, const Pose& to, double axis_length);

}  // namespace flank::internal
