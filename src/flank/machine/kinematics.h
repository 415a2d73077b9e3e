/// Forward and inverse kinematics of any chain of three linear and two rotary joints.
///
/// Poses here are of the controlled point and the unit vector towards the holder, in the frame of the work: that of the
/// table, which is the machine's where all joints are zero. docs/algorithms/machine.md has the derivation.
#pragma once

#include <Eigen/Geometry>
#include <array>

#include "flank/machine/model/machine.h"
#include "flank/vec.h"

namespace flank::internal {

/// The angles of the rotary joints, of the one nearer to the work and of the one nearer to the tool, radians.
using RotaryValues = std::array<double, 2>;

/// Both ways to turn the tool into a direction.
struct RotarySolutions {
  int count = 0;  ///< 0: out of reach; else 2, which are equal on the border of what is reachable
  std::array<RotaryValues, 2> values{};  ///< each in (-pi, pi]
  bool singular = false;  ///< the tool lies along the first rotary axis: its angle is the one that was given
  double sine = 0.0;      ///< between the tool and the first rotary axis: how far from singular
};

class Kinematics {
 public:
  /// Below this sine the angle of the first rotary joint says nothing any more.
  static constexpr double kSingularSine = 1e-9;

  Kinematics(const Machine& machine, double tool_length);

  /// Controlled point and direction in the frame of the work.
  [[nodiscard]] Pose forward(const JointValues& q) const;
  /// Direction alone, from the rotary joints.
  [[nodiscard]] Vec3 direction(const RotaryValues& rotary) const;
  /// Angles for a direction. `first` is what the first rotary joint is where any value would do.
  [[nodiscard]] RotarySolutions rotary(const Vec3& direction, double first) const;
  /// All joints of a controlled point for given rotary angles.
  [[nodiscard]] JointValues joints(const Vec3& point, const RotaryValues& rotary) const;
  [[nodiscard]] RotaryValues rotary_of(const JointValues& q) const { return {q[rotary_[0]], q[rotary_[1]]}; }
  /// Indices into Machine::joints of the rotary joints, the one nearer to the work first.
  [[nodiscard]] const std::array<std::size_t, 2>& rotary_joints() const { return rotary_; }
  /// The rotary joints' part of forward(): the controlled point if all linear joints were zero, and the directions in
  /// which each linear joint moves it.
  struct Frame {
    Vec3 origin = Vec3::Zero();
    std::array<Vec3, 3> linear{};  ///< in the order of the chain
    Vec3 axis = Vec3::UnitZ();
  };
  [[nodiscard]] Frame frame(const RotaryValues& rotary) const;
  /// Sine of the angle between a direction and the first rotary axis; 0: singular.
  [[nodiscard]] double sine_to_first(const Vec3& direction) const {
    return direction.cross(links_[rotary_[0]].direction).norm();
  }
  /// The least of it over all directions from one to another, which run linearly but for their length.
  [[nodiscard]] double sine_to_first(const Vec3& from, const Vec3& to) const;
  /// The motion of what `joints` joints lie before, 0 to kJointCount, from where all joints are zero to q: in the frame of
  /// the work.
  [[nodiscard]] Eigen::Isometry3d link(const JointValues& q, std::size_t joints) const;
  /// The farthest that the controlled point, on its way down the chain, is from a rotary axis, mm.
  [[nodiscard]] double lever(const JointValues& q) const;

 private:
  struct Link {
    bool rotary = false;
    Vec3 direction = Vec3::UnitX(), point = Vec3::Zero();
  };
  std::array<Link, kJointCount> links_;  ///< directions with their signs
  std::array<std::size_t, 2> rotary_{};
  std::array<std::size_t, 3> linear_{};
  Vec3 tip_ = Vec3::Zero(), axis_ = Vec3::UnitZ();
  /// Of the two rotary axes a, b and the tool u0: a R_b(t) u0 = mean + cosine cos t + sine sin t.
  double mean_ = 0.0, cosine_ = 0.0, sine_ = 0.0, swing_ = 0.0, short_of_a_ = 0.0, short_of_minus_a_ = 0.0;
};

}  // namespace flank::internal
