/// A set-up sheet as a page for paper.
#pragma once

#include <string>

#include "flank/sheet/setup_sheet.h"

namespace flank::internal {

/// One HTML page for paper of A4, black on white, that needs nothing else.
[[nodiscard]] std::string sheet_html(const SetupSheet& sheet);

}  // namespace flank::internal
