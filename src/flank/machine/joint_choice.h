/// Which of the two solutions, in which turn of the rotary joints: one continuous choice over a whole path.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "flank/machine/kinematics.h"

namespace flank::internal {

/// A pose of the controlled point in the frame of the work.
struct MachinePose {
  Pose pose;
  bool joined = true;  ///< the tool comes here from the pose before as the path says; else any way will do
};

/// Where a path cannot be run, and why.
struct Unreachable {
  std::size_t pose = 0;
  std::string joint;   ///< its name; empty where it is no joint's fault
  std::string reason;  ///< one sentence for people
};

struct JointChoice {
  std::vector<JointValues> joints;  ///< one for each pose; rotary values unwound, so that they may be interpolated
  std::optional<Unreachable> unreachable;  ///< then `joints` is empty
  int flips = 0;                           ///< changes between the two solutions within joined poses
  double least_sine = 1.0;                 ///< between the tool and the first rotary axis: how near to singular
};

/// The cheapest choice that keeps all travels and, where poses are joined, runs as the path does: dynamic programming over
/// both solutions and all turns within the travel; the price of a step is its time at the rotary joints' speeds. The solution
/// changes only where the path passes the singular direction within `cone` (sine of an angle, > 0): past it on one side, the
/// joints would have to jump, and the first one turns half round instead.
[[nodiscard]] JointChoice choose_joints(const Machine& machine, const Kinematics& kinematics,
                                        std::span<const MachinePose> poses, double cone = Kinematics::kSingularSine);

/// "joint Y would stand at 512.3, its travel is -500 to 500"; empty where all joints keep their travel.
[[nodiscard]] std::string travel_violation(const Machine& machine, const JointValues& q, std::string* joint = nullptr);

}  // namespace flank::internal
