/// `flank wheel`: a whole wheel, from its part to one verdict.
#pragma once

#include "commands.h"

namespace flank::cli {

[[nodiscard]] Subcommand add_wheel(CLI::App& parser);

}  // namespace flank::cli
