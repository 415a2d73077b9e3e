#include "redesign_command.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <memory>

#include "flank/printable.h"
#include "flank/redesign/run_redesign.h"
#include "job_options.h"

namespace flank::cli {
using namespace internal;

Subcommand add_redesign(CLI::App& parser) {
  CLI::App* app = parser.add_subcommand(
      "redesign", "Change faces as little as possible so that one pass of a tool mills them exactly");
  auto job = std::make_shared<RedesignJob>();
  auto folder = std::make_shared<std::string>();
  FlagNames names = add_job_options(*app, *job);
  app->add_option("-o,--output", *folder, "Folder for the new part, the tool, its motion and the tables")->required();
  app->footer(
      "Example: flank redesign blade.step --face F1 --weight le=10,root=0.2 -o new\n"
      "Exit 1: no valid solid, not exact, or thinner than required; redesign.txt says which.");
  const auto run = [job, folder](const CommonOptions& common) {
    const Redesign redesign = run_redesign(*job, *folder, terminal_progress(common));
    write_redesign(redesign, *folder);
    if (common.json)
      fmt::print("{}", redesign_json(redesign));
    else if (!common.quiet)
      fmt::print("{}  written to  {}\n", printable(redesign_text(redesign), true), printable(*folder));
    return redesign.met() ? kMeetsRequest : kFallsShort;
  };
  return {app, run, std::move(names)};
}

}  // namespace flank::cli
