/// A design as tables: JSON (docs/schema/design.md), CSV, one HTML page, text for a terminal. Nothing of how long the
/// search took is in them: the same job and part give the same bytes.
#pragma once

#include <string>

#include "flank/design/design_result.h"

namespace flank::internal {

[[nodiscard]] std::string design_json(const DesignResult& result);
/// A line for each tool on each face.
[[nodiscard]] std::string design_csv(const DesignResult& result);
/// Faces against tools; each cell leads to the report of its pair.
[[nodiscard]] std::string design_html(const DesignResult& result);
[[nodiscard]] std::string design_text(const DesignResult& result);

}  // namespace flank::internal
