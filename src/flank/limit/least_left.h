/// Beside what a path leaves: what every tool that is thick enough leaves on the same face, at least (docs/algorithms/bound.md).
#pragma once

#include <optional>

#include "flank/judge.h"
#include "flank/setup/setup.h"

namespace flank::internal {

/// On the target of which most is left, beyond the tolerance, for tools of which no radius is smaller than `radius_mm`: the most that is
/// proved at some places of a coarse net, and at the place where most is left. It takes about a second. None where nothing is proved, of a
/// mesh, or with an allowance.
[[nodiscard]] std::optional<LeastLeft> least_left(const Setup& setup, const VerifyReport& report, double radius_mm);

}  // namespace flank::internal
