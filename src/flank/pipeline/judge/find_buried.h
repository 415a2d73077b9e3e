/// The strips of a path that run inside the material of a job's part, or inside a fixture.
#pragma once

#include <vector>

#include "flank/judge.h"
#include "flank/setup/setup.h"

namespace flank::internal {

/// Inside fixtures and solids all of whose faces are judged, and behind the targets that are open sheets: on the other side than is
/// machined (setup/machined_side.h). `samples` are target_samples of any spacing (target_reach.h).
[[nodiscard]] std::vector<BuriedStrip> find_buried(const Setup& setup, const Tool& tool, const Path& path,
                                                   const std::vector<FaceSamples>& samples);

}  // namespace flank::internal
