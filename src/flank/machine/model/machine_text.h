/// A machine as a table for a terminal, and as JSON for scripts.
#pragma once

#include <string>

#include "flank/machine/model/machine.h"

namespace flank::internal {

[[nodiscard]] std::string machine_to_text(const Machine& machine);
/// Schema "openflank/machine-summary/1": mm, degrees, seconds.
[[nodiscard]] std::string machine_to_json(const Machine& machine);

/// The machines of machine_folder(): name, nesting and description.
[[nodiscard]] std::string machine_list_text();
[[nodiscard]] std::string machine_list_json();

}  // namespace flank::internal
