/// The subcommand `design`.
#pragma once

#include "commands.h"

namespace flank::cli {

[[nodiscard]] Subcommand add_design(CLI::App& parser);

}  // namespace flank::cli
