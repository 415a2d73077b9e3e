/// The subcommand `correct`.
#pragma once

#include "commands.h"

namespace flank::cli {

[[nodiscard]] Subcommand add_correct(CLI::App& parser);

}  // namespace flank::cli
