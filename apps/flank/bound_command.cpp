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

int run_free(const BoundJob& job, const std::string& folder, const CommonOptions& common) {
  const FreeBound result = run_free_bound(job, terminal_progress(common));
  if (!folder.empty()) write_free_bound(result, folder);
  if (common.json)
    fmt::print("{}", free_bound_json(result));
  else if (!common.quiet)
    fmt::print("{}", printable(free_bound_text(result), true));
  return result.complete && result.bound_mm() <= *result.job.tolerance_mm ? kMeetsRequest : kFallsShort;
}

}  // namespace

Subcommand add_bound(CLI::App& parser) {
  CLI::App* app = parser.add_subcommand(
      "bound",
      "Prove what a tool cannot do on a face: the least error, longest contact, and areas it can never finish");
  auto job = std::make_shared<BoundJob>();
  auto folder = std::make_shared<std::string>();
  FlagNames names = add_job_options(*app, *job);
  app->add_option("-o,--output", *folder, "Folder for bound.json and bound.txt, with --map for map.json and map.html");
  app->footer(
      "Example: flank example twisted-blade -o blade.step && flank bound blade.step --face F1 --tool "
      "cylinder:radius=5 --axis-length 30 --tolerance 0.02\n"
      "Without --tool: the error that every tool of large enough radii leaves or makes, at least.\n"
      "Exit 1: some of a face is proved to be out of the tool's reach, or the run was stopped.");
  const auto run = [job, folder](const CommonOptions& common) {
    if (!folder->empty()) require_inputs_kept(*job, *folder);
    if (asks_for_free_tool(*job)) return run_free(*job, *folder, common);
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
