#include "setup_command.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <memory>

#include "behind.h"
#include "flank/printable.h"
#include "flank/sheet/sheet_page.h"

namespace flank::cli {
using namespace internal;
namespace {

int write_sheet(const SheetJob& job, const std::string& output, const CommonOptions& common) {
  ReadFiles inputs;
  for (const std::string& folder : job.folders) {
    require_not_a_result(folder, output);
    inputs.add(inputs_of_folder(folder));
  }
  if (job.nc) inputs.add(*job.nc, "as `nc`");
  require_no_result_there(output);
  inputs.require_not_written(output);
  const Unwritten unwritten(inputs);
  const SetupSheet sheet = make_setup_sheet(job);
  write_file(output, sheet_html(sheet));
  if (common.json)
    fmt::print(
        "{{\n  \"schema\": \"openflank/setup/1\",\n  \"pass\": {},\n  \"operations\": {},\n  \"tools\": {}\n}}\n",
        sheet.verdict.pass(), sheet.operations.size(), sheet.tools.size());
  else if (!common.quiet)
    fmt::print("{} operation{} with {} tool{}: {}  written to  {}\n", sheet.operations.size(),
               sheet.operations.size() == 1 ? "" : "s", sheet.tools.size(), sheet.tools.size() == 1 ? "" : "s",
               sheet.verdict.pass() ? "meets the request" : "does NOT meet the request", printable(output));
  return exit_code(sheet.verdict);
}

}  // namespace

Subcommand add_setup(CLI::App& parser) {
  CLI::App* app = parser.add_subcommand(
      "setup",
      "Write the set-up sheet of a program for paper: part on the table, zero point, tools, operations, verdict");
  auto job = std::make_shared<SheetJob>();
  auto output = std::make_shared<std::string>();
  app->add_option("DIR", job->folders, "Folders of the operations, in the order of the program")->required();
  app->add_option("--nc", job->nc, "The program: gives set-up, numbers of tools, speeds, feeds and times");
  app->add_option("--machine", job->machine, "The machine: a name (flank machine --list) or a file NAME.toml");
  app->add_option("--setup", job->setup, "Set-up of the part x,y,z,a,b,c (mm, degrees). Default: the program's own");
  app->add_option("-o,--output", *output, "Page to write (HTML)")->required();
  app->footer(
      "Example: flank post out --machine linuxcnc-xyzac-trt --spindle 8000 --feed 1000 -o part.nc && flank setup out "
      "--nc "
      "part.nc "
      "--machine linuxcnc-xyzac-trt -o setup.html");
  return {app,
          [job, output](const CommonOptions& common) { return write_sheet(*job, *output, common); },
          {{"folder", "DIR"}, {"nc", "--nc"}, {"machine", "--machine"}, {"setup", "--setup"}}};
}

}  // namespace flank::cli
