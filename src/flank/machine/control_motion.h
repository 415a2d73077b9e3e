/// How a control moves between two blocks, and how far that is from a straight join of poses.
#pragma once

#include "flank/machine/kinematics.h"

namespace flank::internal {

/// The end of a block: the controlled point's pose in the frame of the work and the joints that hold it.
struct BlockEnd {
  Pose pose;
  JointValues joints{};
};

/// What programs of a machine mean between two blocks.
class ControlMotion {
 public:
  ControlMotion(const Machine& machine, const Kinematics& kinematics)
      : kinematics_(kinematics), positions_(machine.positions), join_(machine.join) {}

  /// Programs state the rotary joints, not the tool's direction.
  [[nodiscard]] bool states_rotary() const {
    return positions_ == NcPositions::kJoint || (positions_ == NcPositions::kTipRotary && join_ == NcJoin::kAxes);
  }
  /// Where the tool is at t in [0, 1] of the block.
  [[nodiscard]] Pose pose(const BlockEnd& from, const BlockEnd& to, double t) const;
  /// Where the joints are at t, near those of the ends.
  [[nodiscard]] JointValues joints(const BlockEnd& from, const BlockEnd& to, double t) const;
  /// Bound of |d^2/dt^2| of the point of the axis `height` above the controlled point, mm, over the block.
  [[nodiscard]] double bend(const BlockEnd& from, const BlockEnd& to, double height) const;

 private:
  const Kinematics& kinematics_;
  NcPositions positions_;
  NcJoin join_;
};

/// The angles that turn the tool into a direction, nearest to `near` of both solutions and all turns.
[[nodiscard]] RotaryValues nearest_rotary(const Kinematics& kinematics, const Vec3& direction,
                                          const RotaryValues& near);

}  // namespace flank::internal
