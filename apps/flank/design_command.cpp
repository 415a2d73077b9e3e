// design.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <memory>

#include "batch_options.h"
#include "design_command.h"
#include "flank/design/design.h"
#include "flank/design/design_tables.h"
#include "flank/printable.h"
#include "job_options.h"

namespace flank::cli {
using namespace internal;

Subcommand add_design(CLI::App& parser) {
  CLI::App* app =
      parser.add_subcommand("design", "Find the set of tools that finishes several faces in the least time");
  auto job = std::make_shared<DesignJob>();
  FlagNames names = add_job_options(*app, *job);
  const auto batch = add_batch_options(*app);
  app->footer(
      "Example: flank example cavity-cone -o cavity.step && flank design cavity.step --faces F1,F2 --tools auto "
      "--tolerance 0.1 -o out");
  const auto run = [job, batch](const CommonOptions& common) {
    const BatchRun whole = batch();
    const DesignResult result = run_design(*job, whole, terminal_progress(common));
    if (common.json)
      fmt::print("{}", design_json(result));
    else if (!common.quiet)
      fmt::print("{}  written to  {}\n", printable(design_text(result), true), printable(whole.folder));
    return result.pass() ? kMeetsRequest : kFallsShort;
  };
  return {app, run, std::move(names)};
}

}  // namespace flank::cli
