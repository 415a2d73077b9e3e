/// What one kind of plan has to tell and others have not: lines for people, JSON for programs (docs/schema/summary.md).
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "flank/run.h"

namespace flank::internal {

/// A line for each target of a cover, the figures of a cavity, of a fit what every step of stiffness costs.
[[nodiscard]] std::string plan_lines(const Result& result);

/// Adds the keys of the result's plan. "candidates", "before" and "after" are the same for every kind, so that scripts can
/// compare them.
void add_plan(const Result& result, nlohmann::ordered_json& json);

}  // namespace flank::internal
