/// The subcommand `redesign`.
#pragma once

#include "commands.h"

namespace flank::cli {

[[nodiscard]] Subcommand add_redesign(CLI::App& parser);

}  // namespace flank::cli
