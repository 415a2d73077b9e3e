/// Which way a tool leaves the surface that it has cut.
#pragma once

#include <vector>

#include "flank/judge.h"

namespace flank::internal {

/// A way off for each pose, across the tool's axis: that of length `lift_mm`, or less, or none, on which the tool keeps
/// farthest from the samples, and likewise while it then runs along its axis for `run_mm`. Parallel; the same for any
/// number of threads.
[[nodiscard]] std::vector<Vec3> lifts_off(const Tool& tool, const std::vector<Pose>& poses,
                                          const std::vector<FaceSamples>& samples, double lift_mm, double run_mm);

}  // namespace flank::internal
