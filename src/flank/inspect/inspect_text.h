/// The table of faces as text.
#pragma once

#include <string>

#include "flank/inspect.h"

namespace flank::internal {

/// For people: a header, one line a face, then what was repaired.
[[nodiscard]] std::string to_table(const InspectReport& report);

/// Indented JSON, schema "openflank/inspect/1"; lengths in mm, an infinite radius is null.
[[nodiscard]] std::string inspect_to_json(const InspectReport& report);

}  // namespace flank::internal
