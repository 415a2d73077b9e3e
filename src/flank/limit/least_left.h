/// Beside what a path leaves: what every tool of such radii leaves at the same place, at least (docs/algorithms/bound.md).
#pragma once

#include <optional>

#include "flank/judge.h"
#include "flank/setup/setup.h"

namespace flank::internal {

/// At the place of the targets where most is left, beyond the tolerance; for tools of which no radius is smaller than the ball of
/// what is accessible (VerifyReport::reach_radius_mm). None where nothing is proved, of a mesh, or with an allowance.
[[nodiscard]] std::optional<LeastLeft> least_left(const Setup& setup, const VerifyReport& report);

}  // namespace flank::internal
