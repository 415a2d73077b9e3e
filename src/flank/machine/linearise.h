/// From poses to blocks: as few as keep the control's true motion within a bound of the planned one.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "flank/machine/control_motion.h"
#include "flank/machine/joint_choice.h"

namespace flank::internal {

/// The part of the tool that must stay where it was planned: heights above the controlled point, mm.
struct ToolSpan {
  double low = 0.0;   ///< of the axis point s = 0
  double high = 0.0;  ///< of the flank's upper end
};

struct LineariseOptions {
  double deviation = 1e-4;              ///< mm, > 0: between the true motion and the planned one, anywhere on the span
  std::size_t most_blocks = 5'000'000;  ///< beyond it the path is refused
};

/// The sine of the angle from the singular direction within which a direction may be taken as singular: the flank is off by less than
/// a share of the deviation then.
[[nodiscard]] double singular_cone(const ToolSpan& span, double deviation);

/// One strip as blocks. Blocks end at planned poses, or between them where the control needs more.
struct LinearisedStrip {
  std::vector<BlockEnd> blocks;  ///< the first is where the strip begins
  std::vector<double> at;        ///< of each: planned pose index and fraction
  std::size_t inserted = 0;      ///< ends between two planned poses
  std::size_t left_out = 0;      ///< planned poses that are no ends
  double deviation_mm = 0.0;     ///< proven bound between the true motion and the planned one
  bool complete = true;          ///< false: most_blocks was not enough
};

/// `poses` are of the controlled point, in the frame of the work, and stand for axis points (ToolSpan) that the path joins
/// straight; `joints` are those of choose_joints. At least one pose.
[[nodiscard]] LinearisedStrip linearise(const Kinematics& kinematics, const ControlMotion& control,
                                        std::span<const Pose> poses, std::span<const JointValues> joints,
                                        const ToolSpan& span, const LineariseOptions& options);

}  // namespace flank::internal
