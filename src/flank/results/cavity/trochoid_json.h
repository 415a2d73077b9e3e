/// A cavity's figures: lines for people, JSON for programs (docs/schema/summary.md).
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "flank/run.h"

namespace flank::internal {

[[nodiscard]] std::string trochoid_lines(const TrochoidSummary& cavity);
[[nodiscard]] nlohmann::ordered_json trochoid_to_json(const TrochoidSummary& cavity);

}  // namespace flank::internal
