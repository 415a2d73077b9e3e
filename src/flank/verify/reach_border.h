/// Where the reachable part of a face ends.
#pragma once

#include <cstddef>
#include <vector>

#include "flank/judge.h"

namespace flank::internal::verify {

/// The samples, ascending, in whose cells that may be: those that are reachable in part, and those that are and are not side by
/// side. Empty where no reachable share is known.
[[nodiscard]] std::vector<std::size_t> reach_border(const FaceSamples& samples);

}  // namespace flank::internal::verify
