/// Which way a tool leaves the surface that it has cut.
#pragma once

#include <vector>

#include "flank/judge.h"
#include "flank/machine/links.h"

namespace flank::internal {

/// An end of a strip: where the tool touches last, and which way it was going.
struct StripEnd {
  Pose contact;
  Vec3 going = Vec3::Zero();  ///< any length; of the axis' middle, past the end
};

/// A lead for each end, `lift_mm` off the surface, or less, or none: that on which the tool keeps farthest from the samples, and
/// likewise while it then runs along its axis for `run_mm`. On an arc past the end where that keeps at least half as far
/// from everything as the best straight way. Parallel; the same for any number of threads.
[[nodiscard]] std::vector<Lead> leads_off(const Tool& tool, const std::vector<StripEnd>& ends,
                                          const std::vector<FaceSamples>& samples, double lift_mm, double run_mm);

}  // namespace flank::internal
