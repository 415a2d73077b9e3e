/// Where a part could sit so that a machine reaches all of a path.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "flank/machine/body_check.h"
#include "flank/machine/joint_choice.h"
#include "flank/machine/work_setup.h"

namespace flank::internal {

/// What was found, or what the nearest miss lacks.
struct FoundSetup {
  std::optional<WorkSetup> setup;
  std::string reason;       ///< without a set-up: why the last one tried does not fit
  double least_sine = 0.0;  ///< of the angle between the tool and the first rotary axis
  int tried = 0;
};

/// Where the controlled point stands when a program begins and ends, in the part's frame, for the direction (unit, in that
/// frame) of the tool with the rotary joints at zero.
using UprightPlace = std::function<Pose(const Vec3&)>;

/// All poses of the controlled point in a set-up, in the part's frame: of each operation and copy, from upright to upright.
using WholeWays = std::function<std::vector<std::vector<Pose>>(const WorkSetup&)>;

/// How the part can be clamped. Nothing given: any way up, anywhere.
struct Clamping {
  std::optional<Vec3> up = {};  ///< unit vector of the part that points to the spindle with the rotary joints at zero
  std::optional<Vec3> centred =
      {};  ///< a point of the part that is on the axis of the rotary joint that carries the part
};

/// What is to be reached, in the part's frame.
struct SetupSearch {
  std::vector<Pose> poses;         ///< of the controlled point
  std::vector<bool> cutting = {};  ///< of each of them: along a strip, not on a link; empty: all are
  UprightPlace upright = {};       ///< where the machine must reach, too
  WholeWays whole = {};            ///< none: the poses alone
  Clamping clamping = {};
};

/// Tries turns of the part: the 24 that keep its axes along the machine's, as far as the clamping lets them, then the path's middle
/// direction at several tilts; and for each of them places on the table. Among those within all travels wins the one in which most
/// rotary joints stand still while the tool cuts, that keeps away from the singular direction (up to 30 degrees, and where the second
/// rotary joint moves), turns its rotary joints least, tilts least, and leaves most of the travels. Of a path of many poses
/// few are tried, and all of a set-up that would win: at none is a joint beyond its travel. At none of the few may the `solids` meet
/// (body_check.h). Throws UsageError for a part that is to be centred on a table that does not turn.
[[nodiscard]] FoundSetup search_setup(const Machine& machine, const Kinematics& kinematics, const SetupSearch& search,
                                      std::span<const SolidBody> solids = {});

}  // namespace flank::internal
