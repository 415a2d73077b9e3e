/// A shank that nobody has given: as thick as the flank ends, and long enough to reach out of the part.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "flank/job/check_fields.h"
#include "flank/run.h"
#include "flank/setup/tool_body.h"

namespace flank::internal {

/// The job, if nothing in it contradicts a shank that is chosen. Throws UsageError.
template <class Job>
[[nodiscard]] const Job& checked_for_auto(const Job& job) {
  check_fields(job);
  check_obstacles(job.obstacles, nullptr);
  return job;
}

/// A shank for a path that was planned without one, into the request: as thick as the flank ends, or the standard diameter just below it, and
/// out of the part along all of the path. Equips the tool with it.
void take_shank(const Path& path, const Box3& part, ObstacleRequest& obstacles, Tool& tool);

/// Plans with a shank that is chosen for what was found (`plan` does so for a job whose shank is "auto"). Where it comes too near all the
/// same, plans again with it in the way from the beginning; the better of the two. A note says the shank's figures.
template <class Job>
[[nodiscard]] Result with_auto_shank(const Job& job, const Progress& progress,
                                     const std::function<Result(const Job&, const Progress&)>& plan);

}  // namespace flank::internal
