/// A shank that nobody has given: as thick as the flank ends, and long enough to reach out of the part.
#pragma once

#include <functional>

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

/// Plans without a shank, then with one that reaches out of the box of the part along the whole path found, and again where the path that
/// takes it needs a longer one. The job of the result has the shank's figures; a note says them. `run` plans one job.
template <class Job>
[[nodiscard]] Result with_auto_shank(const Job& job, const Progress& progress,
                                     const std::function<Result(const Job&, const Progress&)>& run);

}  // namespace flank::internal
