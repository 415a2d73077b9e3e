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

/// Tries turns of the part: the 24 that keep its axes along the machine's, then the path's middle direction at several
/// tilts; and for each of them places on the table. Among those within all travels wins the one that keeps away from the
/// singular direction (up to 30 degrees), tilts least, and leaves most of the travels. `poses` are of the controlled point
/// in the part's frame; a path of many is thinned. At none of them may the `solids` meet (body_check.h). `upright`: where the machine must
/// reach, too.
[[nodiscard]] FoundSetup search_setup(const Machine& machine, const Kinematics& kinematics,
                                      const std::vector<Pose>& poses, std::span<const SolidBody> solids = {},
                                      const UprightPlace& upright = {});

}  // namespace flank::internal
