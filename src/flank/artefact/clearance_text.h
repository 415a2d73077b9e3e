/// Clearances as lines for people.
#pragma once

#include <string>

#include "flank/clearance.h"

namespace flank::internal {

/// One line per figure: "  shank       keeps 0.1230 mm from other faces, true to 0.0010 mm: F88 at ...".
[[nodiscard]] std::string clearance_text(const ClearanceReport& report);

}  // namespace flank::internal
