/// From the words of a job to its part: faces, their sides, fixtures.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flank/setup/setup.h"

namespace flank::internal {

/// Reads the part, finds its faces, and reads the fixtures. Without a tolerance the targets get their default_tolerance. `notes` gets what
/// was repaired, which faces are not checked, and that tolerance. Throws UsageError and InputError.
[[nodiscard]] Setup read_setup(const PartRequest& part, const ObstacleRequest& obstacles,
                               std::optional<double> tolerance_mm, std::vector<std::string>& notes);

}  // namespace flank::internal
