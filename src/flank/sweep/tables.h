/// A sweep as tables: JSON (docs/schema/sweep.md), CSV, one HTML page, text for a terminal. No times are in them: the same
/// plan and part give the same bytes.
#pragma once

#include <string>

#include "flank/sweep/sweep_result.h"

namespace flank::internal {

[[nodiscard]] std::string sweep_json(const SweepResult& result);
[[nodiscard]] std::string sweep_csv(const SweepResult& result);
/// For each variant a table of faces against tools; each cell leads to the report of its task.
[[nodiscard]] std::string sweep_html(const SweepResult& result);
[[nodiscard]] std::string sweep_text(const SweepResult& result);

}  // namespace flank::internal
