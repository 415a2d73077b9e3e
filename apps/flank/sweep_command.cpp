// sweep.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <filesystem>
#include <memory>

#include "commands.h"
#include "flank/base/printable.h"
#include "flank/sweep/sweep.h"
#include "flank/sweep/tables.h"
#include "flank/threads.h"

namespace flank::cli {
using namespace internal;

Subcommand add_sweep(CLI::App& parser) {
  CLI::App* app = parser.add_subcommand(
      "sweep", "Run fit or cover on many faces with many tools, as a plan says, and compare the results");
  auto file = std::make_shared<std::string>();
  auto options = std::make_shared<SweepOptions>();
  auto processes = std::make_shared<int>(0);
  app->add_option("PLAN", *file, "The plan, NAME.toml (docs/schema/sweep.md)")->required();
  app->add_option("-o,--output", options->folder, "Folder for all results")->required();
  app->add_option("--processes", *processes, "Tasks at a time; 0: one for each core. The results do not depend on it")
      ->capture_default_str()
      ->check(CLI::Range(0, 1024));
  app->add_flag("--resume", options->resume, "Keep what an earlier run of the same tasks has done");
  app->footer("Example: flank sweep plan.toml -o out --processes 4");
  const auto run = [file, options, processes](const CommonOptions& common) {
    const SweepPlan plan = read_plan(*file);
    options->program = std::filesystem::read_symlink("/proc/self/exe").string();
    options->processes = *processes > 0 ? *processes : thread_count();
    const SweepResult result = run_sweep(plan, *options, terminal_progress(common));
    if (common.json)
      fmt::print("{}", sweep_json(result));
    else if (!common.quiet)
      fmt::print("{}  written to  {}\n", printable(sweep_text(result), true), printable(options->folder));
    return result.pass() ? kMeetsRequest : kFallsShort;
  };
  return {app, run, {}};
}

}  // namespace flank::cli
