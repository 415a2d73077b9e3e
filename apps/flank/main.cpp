// The command: all subcommands, and the child that reads a CAD file.
#include <CLI/CLI.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "bound_command.h"
#include "command_line.h"
#include "correct_command.h"
#include "design_command.h"
#include "flank/cad_process.h"
#include "help.h"
#include "redesign_command.h"
#include "setup_command.h"
#include "wheel_command.h"

namespace {

/// In the order of the help text.
std::vector<flank::cli::Subcommand> all_commands(CLI::App& parser) {
  using namespace flank::cli;
  return {add_inspect(parser),  add_fit(parser),     add_cover(parser),   add_trochoid(parser), add_wheel(parser),
          add_verify(parser),   add_report(parser),  add_view(parser),    add_post(parser),     add_studio(parser),
          add_tool(parser),     add_machine(parser), add_design(parser),  add_sweep(parser),    add_bound(parser),
          add_redesign(parser), add_correct(parser), add_example(parser), add_fields(parser),   add_setup(parser)};
}

}  // namespace

int main(int argc, char** argv) {
  flank::end_with_parent();
  flank::cli::keep_standard_streams();
  if (const std::optional<int> code = flank::serve_as_cad_reader(argc, argv)) return *code;
  const std::vector<std::string> words{argv + 1, argv + std::max(1, argc)};
  return flank::cli::run_command_line(flank::cli::with_help_words(words), all_commands);
}
