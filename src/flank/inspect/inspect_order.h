/// Which rows of the table of faces are shown, and in which order.
#pragma once

#include <string>
#include <vector>

#include "flank/inspect.h"

namespace flank::internal {

/// What rows may be sorted by.
[[nodiscard]] const std::vector<std::string>& sorts();

/// Keeps the rows of the wanted type and sorts them; equal ones stay in the order of the file. Throws UsageError for a type
/// that no row has, with those that there are, and for an order that is none of sorts().
void arrange(const InspectOrder& order, std::vector<InspectRow>& rows);

}  // namespace flank::internal
