// studio.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <filesystem>
#include <memory>
#include <thread>

#include "commands.h"
#include "flank/error.h"
#include "flank/part.h"
#include "flank/printable.h"
#include "flank/report.h"
#include "flank/studio/studio.h"

namespace flank::cli {
using namespace internal;
namespace {

/// This very program, wherever it was started from.
std::string this_program() {
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) throw InternalError("/proc/self/exe cannot be read; the studio cannot start its children");
  return program.string();
}

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

}  // namespace

Subcommand add_studio(CLI::App& parser) {
  CLI::App* app =
      parser.add_subcommand("studio", "Open the studio in the browser: drop a part, click a face, run, check, post");
  auto options = std::make_shared<StudioOptions>();
  auto open = std::make_shared<bool>(true);
  options->folder = "flank-studio";
  app->add_option("PART", options->part, part_formats() + " file to open first");
  app->add_option("--unit", options->unit, "Unit of a mesh, or of a CAD file that states a wrong one: mm, cm, m or in")
      ->check(CLI::IsMember({"mm", "cm", "m", "in"}));
  app->add_option("-o,--output", options->folder, "Folder of parts and jobs; an earlier one is continued")
      ->capture_default_str();
  app->add_option("--port", options->port, "Port on 127.0.0.1; 0: any free port")
      ->capture_default_str()
      ->check(CLI::Range(0, 65535));
  app->add_flag("--browser,!--no-browser", *open, "Open the page in the browser; --no-browser only prints its address");
  app->footer("Example: flank example twisted-blade -o blade.step && flank studio blade.step");
  return {app,
          [options, open](const CommonOptions& common) {
            const Progress progress = terminal_progress(common);
            run_studio(
                *options, this_program(),
                [&](const std::string& address) { say_address(address, *options, *open, common); }, progress.cancelled);
            return kMeetsRequest;
          },
          {{"studio", "studio"}}};
}

}  // namespace flank::cli
