// The program that `flank studio` becomes: flank-studio COMMAND studio ... serves the page; COMMAND is the flank that computes.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cstdio>
#include <exception>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "command_line.h"
#include "flank/cad_process.h"
#include "flank/printable.h"
#include "flank/report.h"
#include "studio_options.h"

namespace flank::cli {
namespace {

using internal::StudioOptions;

void say_address(const std::string& address, const StudioOptions& options, bool open, const CommonOptions& common) {
  if (common.json)
    fmt::print("{{\"schema\": \"openflank/studio-address/1\", \"url\": \"{}\"}}\n", address);
  else
    fmt::print("{}\n", address);
  if (!common.json && !common.quiet)
    fmt::print("for this computer only; parts and jobs are kept in {}; Ctrl-C ends the studio\n",
               printable(options.folder));
  std::fflush(stdout);
  if (!open) return;
  // A browser may take its time, or all of it.
  std::thread([address] {
    try {
      open_page(address);
    } catch (const std::exception&) {  // the address is there to be copied
    }
  }).detach();
}

Subcommand add_server(CLI::App& parser, const std::string& command) {
  const auto words = std::make_shared<StudioWords>();
  CLI::App* app = add_studio_words(parser, words);
  return {app,
          [words, command](const CommonOptions& common) {
            const Progress progress = terminal_progress(common);
            internal::run_studio(
                words->studio, command,
                [&](const std::string& address) { say_address(address, words->studio, words->open, common); },
                progress.cancelled);
            return kMeetsRequest;
          },
          {{"studio", "studio"}}};
}

}  // namespace
}  // namespace flank::cli

int main(int argc, char** argv) {
  flank::end_with_parent();
  flank::cli::keep_standard_streams();
  if (argc < 3) {
    static_cast<void>(std::fputs("flank-studio: start it by `flank studio`\n", stderr));
    return flank::cli::kWrongUsage;
  }
  const std::string command = argv[1];
  return flank::cli::run_command_line({argv + 2, argv + argc}, [&](CLI::App& parser) {
    return std::vector<flank::cli::Subcommand>{flank::cli::add_server(parser, command)};
  });
}
