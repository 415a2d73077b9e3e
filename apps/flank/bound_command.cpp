// bound.
#include "bound_command.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <memory>

#include "flank/bound/run_bound.h"
#include "flank/printable.h"
#include "job_options.h"

namespace flank::cli {
using namespace internal;

namespace {

int run_map(const BoundJob& job, const std::string& folder, const CommonOptions& common) {
  const PartMap map = run_part_map(job, terminal_progress(common));
  if (!folder.empty()) write_part_map(map, folder);
  if (common.json)
    fmt::print("{}", map_json(map));
  else if (!common.quiet)
    fmt::print("{}", printable(map_text(map), true));
  return map.complete ? kMeetsRequest : kFallsShort;
}

}  // namespace

Subcommand add_bound(CLI::App& parser) {
  CLI::App* app = parser.add_subcommand(
      "bound", "Prove what a tool cannot do on a face: longest contact, and areas it can never finish");
  auto job = std::make_shared<BoundJob>();
  auto folder = std::make_shared<std::string>();
  FlagNames names = add_job_options(*app, *job);
  app->add_option("-o,--output", *folder, "Folder for bound.json and bound.txt, with --map for map.json and map.html");
  app->footer(
      "Example: flank example twisted-blade -o blade.step && flank bound blade.step --face F1 --tool "
      "cylinder:radius=5 --axis-length 30 --tolerance 0.02\n"
      "Exit 1: some of a face is proved to be out of the tool's reach, or the run was stopped.");
  const auto run = [job, folder](const CommonOptions& common) {
    if (!folder->empty()) require_inputs_kept(*job, *folder);
    if (job->map) return run_map(*job, *folder, common);
    const BoundResult result = run_bound(*job, terminal_progress(common));
    if (!folder->empty()) write_bound(result, *folder);
    if (common.json)
      fmt::print("{}", bound_json(result));
    else if (!common.quiet)
      fmt::print("{}", printable(bound_text(result), true));
    return result.complete() && !result.blocked() ? kMeetsRequest : kFallsShort;
  };
  return {app, run, std::move(names)};
}

}  // namespace flank::cli
