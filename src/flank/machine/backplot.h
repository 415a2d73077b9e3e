/// What a machine does with a program: back to a Path, through its forward kinematics and the control's own joins.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flank/machine/control_motion.h"
#include "flank/machine/joint_choice.h"
#include "flank/machine/work_setup.h"
#include "flank/path.h"

namespace flank::internal {

struct BackplotOptions {
  WorkSetup setup;
  double tool_length = 100.0;  ///< from the gauge line to the controlled point, mm
  double tip_offset = 0.0;     ///< from the controlled point to the axis point s = 0, mm
  double axis_length = 0.0;    ///< of the flank, mm
  double chord = 1e-5;         ///< mm, > 0: between the control's motion and the joined poses of the path
};

/// A joint beyond its travel, or faster than it may be.
struct LimitFinding {
  std::int32_t line = 0;
  std::string joint;
  std::string text;
};

/// Of a pose: the move that leads to it. A strip's first pose only says where it begins, unless `from_afar`.
struct PoseMove {
  std::int32_t line = 0;
  bool rapid = false;
  bool from_afar = false;  ///< the machine came here from its reference position, by a way that is not known
};

struct Backplot {
  Path path;  ///< in the part's frame; what no comment claims is a link, or a strip where it cuts
  std::vector<std::vector<PoseMove>> moves;  ///< of each pose of each strip of the path
  std::vector<JointValues> joints;           ///< at the end of each move
  /// Between and at the ends of moves, so near that joints run straight from each to the next; and the line of each.
  std::vector<JointValues> track;
  std::vector<std::int32_t> track_lines;
  std::vector<double> seconds;       ///< of each move, as its feed has it; rapids at the machine's rapid
  std::vector<LimitFinding> travel;  ///< joints beyond their travel, at most one of each joint
  std::vector<LimitFinding> speed;   ///< joints that would have to be faster than they can, likewise
  double chord_bound_mm = 0.0;       ///< proven
  double time_s = 0.0;
};

/// Throws InputError naming `file`, line and joint for a pose that no joint values reach, and for a program whose positions
/// or rotary axes are not those of the machine.
[[nodiscard]] Backplot backplot(const Machine& machine, const NcProgram& program, const std::string& file,
                                const BackplotOptions& options);

}  // namespace flank::internal
