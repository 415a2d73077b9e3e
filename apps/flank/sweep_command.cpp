// sweep.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <memory>

#include "batch_options.h"
#include "commands.h"
#include "flank/printable.h"
#include "flank/sweep.h"

namespace flank::cli {

Subcommand add_sweep(CLI::App& parser) {
  CLI::App* app =
      parser.add_subcommand("sweep", "Run fit or cover on many faces with many tools, and compare the results");
  auto file = std::make_shared<std::string>();
  app->add_option("PLAN", *file, "The plan, NAME.toml (docs/schema/sweep.md)")->required();
  const auto batch = add_batch_options(*app);
  app->footer("Example: flank sweep plan.toml -o out --processes 4");
  const auto run = [file, batch](const CommonOptions& common) {
    const BatchRun whole = batch();
    const BatchOutcome outcome = run_sweep(*file, whole, terminal_progress(common));
    if (common.json)
      fmt::print("{}", outcome.json);
    else if (!common.quiet)
      fmt::print("{}  written to  {}\n", printable(outcome.table, true), printable(whole.folder));
    return outcome.pass ? kMeetsRequest : kFallsShort;
  };
  return {app, run, {}};
}

}  // namespace flank::cli
