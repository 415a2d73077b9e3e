/// The subcommand `bound`.
#pragma once

#include "commands.h"

namespace flank::cli {

[[nodiscard]] Subcommand add_bound(CLI::App& parser);

}  // namespace flank::cli
