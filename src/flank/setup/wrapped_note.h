/// What is said of targets that go round an edge.
#pragma once

#include <string>
#include <vector>

#include "flank/part.h"

namespace flank::internal {

/// Targets that go round an edge: those with two sides, which are machined in pieces, and those with one, which may be. Empty if none
/// does.
[[nodiscard]] std::string wrapped_note(const Part& part, const std::vector<int>& targets);

}  // namespace flank::internal
