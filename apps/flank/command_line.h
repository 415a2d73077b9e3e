/// What the programs `flank` and `flank-studio` share: a command line of some commands, its errors and its exit codes.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "commands.h"

namespace flank::cli {

/// Adds commands to the parser, in the order of the help text.
using AddCommands = std::function<std::vector<Subcommand>(CLI::App& parser)>;

/// Runs the command that the words, those behind the program's name, choose, and returns the exit code; errors are a line on stderr.
[[nodiscard]] int run_command_line(const std::vector<std::string>& words, const AddCommands& add);

/// Gives each standard stream that is closed a descriptor that can be neither read nor written: another file that gets its
/// number would be taken for it.
void keep_standard_streams();

}  // namespace flank::cli
