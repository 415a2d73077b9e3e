/// `flank setup`: the sheet of paper that goes to the machine with a program.
#pragma once

#include "commands.h"

namespace flank::cli {

[[nodiscard]] Subcommand add_setup(CLI::App& parser);

}  // namespace flank::cli
