// machine and post.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "behind.h"
#include "commands.h"
#include "flank/error.h"
#include "flank/machine.h"
#include "flank/machine/model/machine_file.h"
#include "flank/printable.h"
#include "flank/run.h"
#include "job_options.h"

namespace flank::cli {
using namespace internal;

Subcommand add_machine(CLI::App& parser) {
  CLI::App* app = parser.add_subcommand("machine", "Show and check a machine: its axes, limits and control");
  auto name = std::make_shared<std::string>();
  auto list = std::make_shared<bool>(false);
  app->add_option("MACHINE", *name, "A machine that comes with flank, or a file NAME.toml (docs/schema/machine.md)");
  app->add_flag("--list", *list, "List the machines that come with flank");
  app->footer("Examples: flank machine --list; flank machine linuxcnc-xyzac-trt");
  const auto run = [name, list](const CommonOptions& common) {
    if (name->empty() && !*list) throw UsageError("machine", "expected a name or a file, or `list`");
    if (*list) {
      fmt::print("{}", common.json ? flank::machine_list_json() : printable(machine_list_table(), true));
      return kMeetsRequest;
    }
    // Read, and refused where it is none, also if nothing is said.
    const std::string text = common.json ? machine_json(*name) : printable(machine_table(*name), true);
    if (common.json || !common.quiet) fmt::print("{}", text);
    return kMeetsRequest;
  };
  return {app, run, {{"machine", "MACHINE"}, {"list", "--list"}}};
}

namespace {

/// All that post reads: the folder with its part and fixtures, what the request names, the machine's file.
ReadFiles inputs_of(const PostJob& job) {
  ReadFiles files = inputs_of_folder(job.folder);
  for (const std::string& folder : job.more_folders) files.add(inputs_of_folder(folder));
  for_each_input(job, [&](const FieldInfo& info, const std::string& word) {
    if (info.key != "folder" && info.key != "more_folders") files.add(word, "as `" + field_name(info) + "`");
  });
  files.add(machine_file(job.machine), "as `machine`");
  return files;
}

/// Before the program is written: whether what keep_motion writes has its place.
void require_place_of_motion(const std::string& path) {
  const ResultFolder folder(path, ResultFolder::Use::kWriteOrRead);
  if (folder.manifest() && folder.writable()) folder.require_own("motion.json");
}

/// Beside the result, for its report. A folder that may not be written, or that other programs made, stays as it is.
void keep_motion(const std::string& path, const std::string& motion) {
  ResultFolder folder(path, ResultFolder::Use::kWriteOrRead);
  if (folder.manifest() && folder.writable()) folder.add({{"motion.json", motion}}, *folder.manifest());
}

}  // namespace

Subcommand add_post(CLI::App& parser) {
  CLI::App* app = parser.add_subcommand(
      "post", "Write the NC program with which a machine runs the path of a folder, or those of several");
  auto job = std::make_shared<PostJob>();
  auto output = std::make_shared<std::string>();
  FlagNames names = add_job_options(*app, *job);
  app->add_option("-o,--output", *output, "NC program to write")->required();
  app->footer(
      "Example: flank example twisted-blade -o blade.step && flank fit blade.step --face F1 --tolerance 0.1 -o out; "
      "flank post out --machine linuxcnc-xyzac-trt --spindle 8000 --feed 1000 -o blade.ngc && flank verify out --nc "
      "blade.ngc --machine "
      "linuxcnc-xyzac-trt\nSeveral operations, each with its own tool: flank post rough finish --machine "
      "linuxcnc-xyzac-trt "
      "--material steel-c45 --flutes 4 -o part.nc && flank verify rough finish --nc part.nc --machine "
      "linuxcnc-xyzac-trt");
  const auto run = [job, output](const CommonOptions& common) {
    std::vector<std::string> folders{job->folder};
    folders.insert(folders.end(), job->more_folders.begin(), job->more_folders.end());
    for (const std::string& folder : folders) require_not_a_result(folder, *output);
    require_no_result_there(*output);
    const ReadFiles inputs = inputs_of(*job);
    inputs.require_not_written(*output);
    const Unwritten unwritten(inputs);
    for (const std::string& folder : folders) require_place_of_motion(folder);
    const PostOutcome outcome = run_post(*job);
    // A program that cuts what it should not is not left lying about for somebody to run.
    const bool written = outcome.acceptance.pass() || job->force;
    if (written) {
      write_file(*output, outcome.program);
      for (const PostOperation& operation : outcome.operations)
        if (operation.copy == 1) keep_motion(operation.folder, operation.motion);
    }
    if (common.json)
      fmt::print("{}", post_json(outcome));
    else if (!common.quiet)
      fmt::print("{}  {} {}\n", printable(post_text(outcome), true),
                 written ? "written to " : "not written without --force: ", printable(*output));
    return exit_code(outcome.acceptance);
  };
  return {app, run, std::move(names)};
}

}  // namespace flank::cli
